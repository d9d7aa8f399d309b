#pragma once

#include <array>
#include <cstdlib>
#include <filesystem>

#include "core/volume.h"
#include "io/volume_reader.h"

namespace nacre {

/// A file of the test data, and the window it is seen through.
struct Scan {
  const char* name;
  const char* file;
  double lo;
  double hi;
};

inline constexpr Scan kHeadScan{"chris_MRA", "chris_MRA.nii.gz", 20.0, 230.0};
inline constexpr std::array kScans{kHeadScan,
                                   Scan{"aneurism", "aneurism_256_uint8.nrrd", 20.0, 250.0},
                                   Scan{"MR_Gd", "MR_Gd.nii.gz", 648.0, 1556.0}};

/// Whether NACRE_TEST_DATA names the folder of the test data.
inline bool has_test_data() { return std::getenv("NACRE_TEST_DATA") != nullptr; }

/// A file of that folder.
/// @pre  has_test_data()
inline std::filesystem::path test_data(const std::filesystem::path& file) {
  return std::filesystem::path(std::getenv("NACRE_TEST_DATA")) / file;
}

inline Volume read_scan(const std::filesystem::path& file) {
  return read_volume(test_data("volumes" / file)).volume;
}

}  // namespace nacre
