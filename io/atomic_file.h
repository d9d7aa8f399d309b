#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace nacre {

/// A file that appears under its name only when it is whole.
///
/// Bytes go to a temporary name in the same folder; `commit` renames it. Without `commit` (an error
/// on the way) nothing is left behind, and a file that was there before stays as it was. A name
/// that is a device or a pipe ("/dev/stdout") is written to directly; a symbolic link keeps
/// pointing where it did, and its target is replaced.
class AtomicFile {
 public:
  /// @throws Error  BadArgument if no file can be created there
  explicit AtomicFile(const std::filesystem::path& path);

  /// Removes the temporary file unless committed.
  ~AtomicFile();

  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends bytes.
  /// @throws Error  Unsupported if they cannot be written (a full disk)
  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);

  /// Flushes and closes, but keeps the temporary name: `commit` is then only the renaming. So many
  /// files can be written before the first of them appears.
  /// @throws Error  Unsupported if the last bytes cannot be written
  void close();

  /// Flushes, closes and renames. Nothing may be written afterwards.
  /// @throws Error  Unsupported if the last bytes or the name cannot be written
  void commit();

  /// Where the bytes lie before `commit`.
  const std::filesystem::path& temporary_path() const noexcept { return temporary_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace nacre
