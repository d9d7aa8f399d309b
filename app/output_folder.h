#pragma once

#include <deque>
#include <filesystem>
#include <string>

#include "io/atomic_file.h"

namespace nacre {

/// The files of a report, which appear together in one folder.
class OutputFolder {
 public:
  /// Makes the folder if need be: before the work, which a bad name would waste.
  /// @throws Error  BadArgument if there is none and none can be made
  explicit OutputFolder(const std::filesystem::path& path);

  /// Takes the folder away again if it was made here and nothing was committed.
  ~OutputFolder();

  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Writes a file that appears with `commit`.
  void write(const std::string& name, const std::string& bytes);

  /// Gives all files their names.
  void commit();

 private:
  std::filesystem::path path_;
  bool made_ = false;
  bool done_ = false;
  std::deque<AtomicFile> files_;
};

}  // namespace nacre
