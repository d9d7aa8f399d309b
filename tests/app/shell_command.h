#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/app/phantom_command.h"

namespace nacre::testing {

/// For what needs the shell tools and a GL context.
class ShellCommand : public Command {
 protected:
  void SetUp() override {
    if (!NACRE_HAS_SHELLS) GTEST_SKIP() << "built without the shell tools";
    Command::SetUp();
    ASSERT_EQ(
        nacre("build ball.nii --window 0,28 --levels 7 --certificate none -o ball.glb").status, 0);
  }

  void require_backend() const {
    if (nacre("render --list-backends").output.find("software") == std::string::npos &&
        nacre("render --list-backends").output.find("hardware") == std::string::npos) {
      GTEST_SKIP() << "no OpenGL context opens on this machine";
    }
  }
};

}  // namespace nacre::testing
