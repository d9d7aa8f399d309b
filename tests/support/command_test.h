#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>

#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

namespace nacre::testing {

/// Runs nacre in a folder of its own.
class CommandTest : public ::testing::Test {
 protected:
  CommandResult nacre(const std::string& arguments) const {
    CommandResult result = run_command(NACRE_BINARY, arguments, folder_.path());
    if (result.status != 0) last_failure_ = "nacre " + arguments + "\n" + result.errors;
    return result;
  }

  /// The command fails with this status and one line that holds `part`, and leaves no file.
  void expect_refusal(const std::string& arguments, int status, const std::string& part) const {
    const std::size_t files = folder_.file_count();
    const CommandResult result = nacre(arguments);
    EXPECT_EQ(result.status, status) << arguments << "\n" << result.errors;
    EXPECT_NE(result.errors.find(part), std::string::npos) << arguments << "\n" << result.errors;
    EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
    EXPECT_EQ(result.errors.rfind("nacre: ", 0), 0u) << result.errors;
    EXPECT_EQ(folder_.file_count(), files) << arguments << " left a file";
  }

  /// A test that expects success compares the status alone: what the command said is told here.
  void TearDown() override {
    if (HasFailure()) std::cout << "The last command that failed: " << last_failure_ << "\n";
  }

  ScratchFolder folder_;

 private:
  mutable std::string last_failure_ = "none";
};

}  // namespace nacre::testing
