#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <string>

namespace nacre::testing {

/// A hard case: what is promised of it, what was seen, and what the formula one would write first
/// makes of it. All three are errors in the same unit.
struct StabilityCase {
  std::string name;
  std::string unit;
  double bound = 0.0;
  double seen = 0.0;
  double naive = 0.0;
  std::string naive_formula;  ///< in words
};

/// Expects the error within the bound, and that of the naive formula past it: without that the case
/// would show nothing. Adds a line for docs/stability.md to the file that NACRE_STABILITY_TABLE
/// names, if it does.
inline void expect_held(const StabilityCase& held) {
  EXPECT_LE(held.seen, held.bound) << held.name;
  EXPECT_FALSE(held.naive <= held.bound)
      << held.name << ": " << held.naive_formula << " would do, so the case shows nothing";
  if (const char* path = std::getenv("NACRE_STABILITY_TABLE")) {
    std::ofstream(path, std::ios::app)
        << std::setprecision(3) << "| " << held.name << " | " << held.unit << " | " << held.bound
        << " | " << held.seen << " | " << held.naive_formula << " | " << held.naive << " |\n";
  }
}

}  // namespace nacre::testing
