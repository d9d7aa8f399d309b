#include "io/atomic_file.h"

#include <fmt/core.h>

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

/// A name beside `path` that nobody else is likely to use.
fs::path temporary_name(const fs::path& path) {
  std::random_device random;
  fs::path name = path.parent_path();
  name /= fmt::format(".{}.{:08x}.tmp", path.filename().string(), random());
  return name;
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
  const bool special = is_special(path_);
  temporary_ = special ? path_ : temporary_name(path_);
  file_.reset(std::fopen(temporary_.c_str(), special ? "wb" : "wbx"));
  if (file_ == nullptr) {
    const std::string reason = std::strerror(errno);
    temporary_.clear();
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: cannot be created: {}", path.string(), reason));
  }
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

void AtomicFile::close() {
  if (file_ != nullptr && std::fclose(file_.release()) != 0) {
    throw_unwritable(path_, std::strerror(errno));
  }
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
