#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/scratch_folder.h"

namespace nacre::testing {

/// What a command left behind.
struct CommandResult {
  int status = 0;
  std::string output;  ///< standard output
  std::string errors;  ///< standard error
};

/// Runs `program` with these arguments (as a shell reads them) in a folder; its standard streams go
/// to files outside it.
inline CommandResult run_command(const std::string& program, const std::string& arguments,
                                 const std::filesystem::path& folder) {
  const ScratchFolder streams;
  const auto out = streams.path() / "out";
  const auto err = streams.path() / "err";
  const std::string line = "cd '" + folder.string() + "' && '" + program + "' " + arguments +
                           " > '" + out.string() + "' 2> '" + err.string() + "'";
  const int raw = std::system(line.c_str());
  return {WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw), read_bytes(out),
          read_bytes(err)};
}

}  // namespace nacre::testing
