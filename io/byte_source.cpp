#include "io/byte_source.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace nacre {
namespace {

[[noreturn]] void reject(const std::filesystem::path& path, const std::string& found,
                         const std::string& expected) {
  throw Error(ErrorCode::BadFile,
              fmt::format("{}: found {}, expected {}", path.string(), found, expected));
}

}  // namespace

FileSource::FileSource(const std::filesystem::path& path) : path_(path) {
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0) reject(path, std::strerror(errno), "a file that can be read");
  struct stat facts {};
  if (::fstat(descriptor_, &facts) != 0 || !S_ISREG(facts.st_mode)) {
    ::close(descriptor_);
    reject(path, "something else", "a regular file");
  }
  size_ = static_cast<std::uint64_t>(facts.st_size);
}

FileSource::~FileSource() { ::close(descriptor_); }

std::vector<std::byte> FileSource::read(std::uint64_t offset, std::size_t size) const {
  std::vector<std::byte> bytes(size);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count =
        ::pread(descriptor_, bytes.data() + done, size - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) reject(path_, std::strerror(errno), fmt::format("{} bytes", size));
    if (count == 0) reject(path_, "a file that shrinks", fmt::format("{} bytes", size_));
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

}  // namespace nacre
