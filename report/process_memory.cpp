#include "report/process_memory.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <fstream>
#include <string>

namespace nacre {
namespace {

/// "VmRSS:     1234 kB" of the process, bytes.
std::optional<std::size_t> status_bytes(const std::string& field) {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    std::size_t kibibytes = 0;
    if (word == field && status >> kibibytes) return kibibytes * 1024;
  }
  return std::nullopt;
}

/// Sets the peak back to what is resident now.
bool reset_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5";  // proc(5): resets the peak resident set size
  file.flush();
  return file.good();
}

}  // namespace

MemoryWatch::MemoryWatch() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
  if (reset_peak()) before_ = status_bytes("VmRSS:");
}

std::optional<std::size_t> MemoryWatch::peak_bytes() const {
  const auto peak = status_bytes("VmHWM:");
  if (!before_ || !peak) return std::nullopt;
  return *peak > *before_ ? *peak - *before_ : 0;
}

}  // namespace nacre
