#include "app/output_folder.h"

#include <fmt/core.h>

#include <system_error>

#include "core/error.h"

namespace nacre {

OutputFolder::OutputFolder(const std::filesystem::path& path) : path_(path) {
  std::error_code failed;
  made_ = std::filesystem::create_directory(path, failed);
  if (failed || !std::filesystem::is_directory(path)) {
    throw Error(
        ErrorCode::BadArgument,
        fmt::format("{}: found no folder and none could be made, expected one", path.string()));
  }
}

OutputFolder::~OutputFolder() {
  files_.clear();
  std::error_code ignored;
  if (made_ && !done_) std::filesystem::remove(path_, ignored);  // only an empty folder goes
}

void OutputFolder::write(const std::string& name, const std::string& bytes) {
  files_.emplace_back(path_ / name);
  files_.back().write(bytes);
  files_.back().close();
}

void OutputFolder::commit() {
  for (AtomicFile& file : files_) file.commit();
  done_ = true;
}

}  // namespace nacre
