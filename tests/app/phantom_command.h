#pragma once

#include <gtest/gtest.h>

#include "tests/support/command_test.h"

namespace nacre::testing {

/// The folder starts with a small phantom in it.
class Command : public CommandTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(nacre("phantom spheres --size 20,18,16 -o ball.nii").status, 0);
  }
};

}  // namespace nacre::testing
