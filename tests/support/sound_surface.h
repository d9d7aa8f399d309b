#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "core/triangle_mesh.h"
#include "shells/shell_checks.h"

namespace nacre::testing {

/// The surface is what every shell has to be, with this Euler characteristic.
inline void expect_sound(const TriangleMesh& mesh, std::int64_t euler) {
  const ShellReport report = check_shell(mesh);
  EXPECT_TRUE(report.is_sound());
  EXPECT_EQ(report.euler, euler);
}

}  // namespace nacre::testing
