#include "io/atomic_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <random>
#include <system_error>

#include "core/error.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_unwritable(const fs::path& path, const std::string& reason) {
  throw Error(ErrorCode::Unsupported,
              fmt::format("{}: cannot be written: {}", path.string(), reason));
}

/// The name by which the kernel lets a file without one be linked.
std::string descriptor_path(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

/// A name beside `path` that nobody else is likely to use.
fs::path temporary_name(const fs::path& path) {
  std::random_device random;
  fs::path name = path.parent_path();
  name /= fmt::format(".{}.{:08x}.tmp", path.filename().string(), random());
  return name;
}

/// A file without a name, open for writing; none where the file system or its mount cannot.
std::FILE* open_nameless([[maybe_unused]] const fs::path& folder) {
#ifdef O_TMPFILE
  constexpr mode_t kForAll = 0666;  // less the umask, as for any new file
  const int descriptor =
      open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, kForAll);
  if (descriptor < 0) return nullptr;
  // What cannot be named later is of no use: the name comes through /proc.
  if (access(descriptor_path(descriptor).c_str(), F_OK) == 0) {
    if (std::FILE* file = fdopen(descriptor, "wb")) return file;
  }
  close(descriptor);
#endif
  return nullptr;
}

bool is_special(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : path_(path) {
  std::error_code failure;
  if (fs::is_symlink(path)) path_ = fs::canonical(path, failure);
  if (path_.empty() || path_.filename().empty() || fs::is_directory(path_, failure)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found a folder, expected the name of a file", path.string()));
  }
  if (is_special(path_)) {
    temporary_ = path_;
    file_.reset(std::fopen(path_.c_str(), "wb"));
  } else {
    open_beside();
  }
  if (file_ == nullptr) {
    const std::string reason = std::strerror(errno);
    temporary_.clear();
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: cannot be created: {}", path.string(), reason));
  }
}

void AtomicFile::open_beside() {
  file_.reset(open_nameless(path_.parent_path()));
  if (file_ != nullptr) return;
  temporary_ = temporary_name(path_);
  file_.reset(std::fopen(temporary_.c_str(), "wbx"));
}

AtomicFile::~AtomicFile() {
  file_.reset();
  std::error_code ignored;
  if (!temporary_.empty() && temporary_ != path_) fs::remove(temporary_, ignored);
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
    throw_unwritable(path_, std::strerror(errno));
  }
}

void AtomicFile::write(std::string_view text) {
  write(std::as_bytes(std::span(text.data(), text.size())));
}

/// `linkat` replaces nothing: the file is named beside its place first and then moved there.
void AtomicFile::give_temporary_name() {
  const fs::path name = temporary_name(path_);
  const std::string source = descriptor_path(fileno(file_.get()));
  if (linkat(AT_FDCWD, source.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0) {
    throw_unwritable(path_, std::strerror(errno));
  }
  temporary_ = name;
}

void AtomicFile::close() {
  if (file_ == nullptr) return;
  if (std::fflush(file_.get()) != 0) throw_unwritable(path_, std::strerror(errno));
  if (temporary_.empty()) give_temporary_name();
  if (std::fclose(file_.release()) != 0) throw_unwritable(path_, std::strerror(errno));
}

void AtomicFile::commit() {
  close();
  if (temporary_ == path_) return;
  std::error_code failure;
  fs::rename(temporary_, path_, failure);
  if (failure) throw_unwritable(path_, failure.message());
  temporary_.clear();
}

}  // namespace nacre
