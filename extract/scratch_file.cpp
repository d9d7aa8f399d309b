#include "extract/scratch_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/error.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

constexpr int kNone = -1;

/// A file that never had a name, where the file system can make one.
int open_nameless([[maybe_unused]] const fs::path& folder) {
#ifdef O_TMPFILE
  constexpr mode_t kOwnerOnly = 0600;
  return open(folder.c_str(), O_TMPFILE | O_RDWR | O_EXCL | O_CLOEXEC, kOwnerOnly);
#else
  return kNone;
#endif
}

/// A file that loses its name at once.
int open_and_unlink(const fs::path& folder) {
  std::string name = (folder / ".nacre-XXXXXX").string();
  const int descriptor = mkostemp(name.data(), O_CLOEXEC);
  if (descriptor != kNone) unlink(name.c_str());
  return descriptor;
}

}  // namespace

ScratchFile::Descriptor::~Descriptor() { close(number_); }

std::optional<ScratchFile> ScratchFile::create(const fs::path& folder) {
  const fs::path place = folder.empty() ? fs::path(".") : folder;
  int descriptor = open_nameless(place);
  if (descriptor == kNone) descriptor = open_and_unlink(place);
  if (descriptor == kNone) return std::nullopt;
  return ScratchFile(descriptor);
}

bool ScratchFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = pwrite(descriptor_->number(), bytes.data() + done, bytes.size() - done,
                                 static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

void ScratchFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = pread(descriptor_->number(), bytes.data() + done, bytes.size() - done,
                                static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      throw Error(ErrorCode::Unsupported,
                  fmt::format("scratch file: cannot be read back: {}",
                              count == 0 ? "it ends early" : std::strerror(errno)));
    }
    done += static_cast<std::size_t>(count);
  }
}

}  // namespace nacre
