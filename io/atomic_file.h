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
/// Bytes go to a file in the same folder that has no name where the file system allows that, so
/// that nothing is left behind, however the program ends; elsewhere to one of a temporary name.
/// `commit` gives it its name, in one step also where a file of that name is replaced. Without
/// `commit` (an error on the way) a file that was there before stays as it was. A name that is a
/// device or a pipe ("/dev/stdout") is written to directly; a symbolic link keeps pointing where it
/// did, and its target is replaced.
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

  /// Flushes, names and closes, but under the temporary name: `commit` is then only the renaming.
  /// So many files can be written before the first of them appears.
  /// @throws Error  Unsupported if the last bytes cannot be written
  void close();

  /// Flushes, names, closes and renames. Nothing may be written afterwards.
  /// @throws Error  Unsupported if the last bytes or the name cannot be written
  void commit();

  /// Where the bytes lie before `commit`, if they have a name.
  const std::filesystem::path& temporary_path() const noexcept { return temporary_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  void open_beside();
  void give_temporary_name();

  std::filesystem::path path_;
  std::filesystem::path temporary_;  ///< empty as long as there is no name
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace nacre
