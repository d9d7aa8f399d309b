#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace nacre {

/// What reading a volume found out beside the volume itself.
struct VolumeReadReport {
  std::string format;                 ///< "NIfTI-1", "NRRD", "MetaImage", "DICOM series", "raw"
  std::vector<std::string> warnings;  ///< one line each, without the file's name
  std::size_t nan_count = 0;          ///< samples that were NaN: now the lowest finite value
  std::size_t positive_infinity_count = 0;  ///< now the largest finite stored number
  std::size_t negative_infinity_count = 0;  ///< now the smallest finite stored number
};

}  // namespace nacre
