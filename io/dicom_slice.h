#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "io/stored_samples.h"

namespace nacre {

/// What one DICOM file says about its image. Nothing about the patient is read.
struct DicomSlice {
  std::filesystem::path path;
  std::string series_uid;
  std::int64_t columns = 0;  ///< samples along x
  std::int64_t rows = 0;     ///< samples along y
  std::int64_t frames = 1;
  int samples_per_pixel = 1;
  std::string photometric;  ///< "MONOCHROME2", "RGB", ...
  int bits_allocated = 0;
  int bits_stored = 0;
  int high_bit = 0;
  bool is_signed = false;
  bool has_lookup_table = false;  ///< a modality look-up table instead of slope and intercept
  double slope = 1.0;
  double intercept = 0.0;

  bool has_position = false;    ///< position, directions and spacing were all given
  glm::dvec3 position{0.0};     ///< of the first sample's centre, LPS mm
  glm::dvec3 x_direction{0.0};  ///< along a row
  glm::dvec3 y_direction{0.0};  ///< along a column
  glm::dvec2 spacing_mm{0.0};   ///< along x, along y
  double thickness_mm = 0.0;    ///< 0 where not stated
};

/// Reads what a file says about its image; nothing if it is no DICOM file, or one without an image
/// (DICOMDIR, reports).
/// @throws Error  BadFile if it is a DICOM file, but damaged
std::optional<DicomSlice> read_dicom_slice(const std::filesystem::path& path);

/// Decodes the image's stored samples (x fastest, the machine's byte order) into `samples`, with
/// the bits above those stored cleared, or filled with the sign.
///
/// @pre    `samples` has columns * rows * bits_allocated / 8 bytes
/// @throws Error  BadFile if they cannot be decoded, or are not as many
void read_dicom_samples(const DicomSlice& slice, std::span<std::byte> samples);

}  // namespace nacre
