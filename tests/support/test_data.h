#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace nacre::testing {

/// A file or folder of the shared test data (real scans, not in the repository), looked up in the
/// folder that the environment variable NACRE_TEST_DATA names, else in ../shared/data beside the
/// source tree. Nothing if it is not there: skip the test then, and say so.
inline std::optional<std::filesystem::path> test_data(const std::string& name) {
  const char* named = std::getenv("NACRE_TEST_DATA");
  std::filesystem::path folder = named != nullptr ? named : "";
  if (folder.empty()) folder = std::filesystem::path(NACRE_SOURCE_DIR) / "../shared/data";
  std::error_code ignored;
  if (!std::filesystem::exists(folder / name, ignored)) return std::nullopt;
  return folder / name;
}

}  // namespace nacre::testing

/// Declares `variable` as the path of a file of the shared test data, or skips the test.
#define NACRE_TEST_DATA_OR_SKIP(variable, name)                                    \
  const auto variable##_found = ::nacre::testing::test_data(name);                 \
  if (!variable##_found) GTEST_SKIP() << "shared test data is absent: " << (name); \
  const auto& variable = *variable##_found
