#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace nacre::testing {

/// A DICOM slice to be written: a 6 x 4 image unless said otherwise.
struct DicomSliceSpec {
  glm::dvec3 position{0.0};
  glm::dvec3 x_direction{1.0, 0.0, 0.0};
  glm::dvec3 y_direction{0.0, 1.0, 0.0};
  std::string pixel_spacing = "0.5\\0.75";  ///< between rows, then between columns
  unsigned columns = 6;
  unsigned rows = 4;
  unsigned frames = 1;
  std::string series_uid = "1.2.3.4";
  std::string photometric = "MONOCHROME2";
  int bits_stored = 16;
  bool is_signed = true;
  std::string slope;      ///< left out if empty
  std::string intercept;  ///< left out if empty
  bool jpeg_lossless = false;
  bool has_position = true;
  std::vector<std::int16_t> samples;  ///< filled with `fill` if empty
  std::int16_t fill = 0;
};

/// Writes one slice as a DICOM file.
void write_dicom(const DicomSliceSpec& spec, const std::filesystem::path& path);

}  // namespace nacre::testing
