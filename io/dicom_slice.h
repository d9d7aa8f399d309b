#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "io/dicom_extent.h"

namespace nacre {

/// What one DICOM file says about its image. Nothing about the patient is read.
struct DicomSlice {
  std::array<char, 65> series_uid_text{};   ///< ended by 0
  std::array<char, 17> photometric_text{};  ///< "MONOCHROME2", "RGB", ..., ended by 0
  DicomExtent extent;                       ///< of its samples in the file
  std::int64_t columns = 0;                 ///< samples along x
  std::int64_t rows = 0;                    ///< samples along y
  std::int64_t frames = 1;
  int samples_per_pixel = 1;
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

  std::string_view series_uid() const { return series_uid_text.data(); }
  std::string_view photometric() const { return photometric_text.data(); }
};

/// Reads what files say about their images; nothing for one that is no DICOM file, or one without
/// an image (DICOMDIR, reports).
///
/// GDCM, which parses them, may end its process where a file is damaged, so it works in a child
/// process (see docs/decisions/003).
///
/// @throws Error  BadFile naming the first file that is DICOM, but damaged
std::vector<std::optional<DicomSlice>> read_dicom_slices(
    const std::vector<std::filesystem::path>& files);

/// Decodes stored samples (x fastest, the machine's byte order), slice after slice, with the bits
/// above those stored cleared, or filled with the sign. In a child process too.
///
/// @param files    one a slice, in the order in which they are to lie in `samples`
/// @param slice    what all of them have in common: size and type
/// @pre            `samples` has files * columns * rows * bits_allocated / 8 bytes
/// @throws Error   BadFile naming the first file that cannot be decoded
void read_dicom_samples(const std::vector<std::filesystem::path>& files, const DicomSlice& slice,
                        std::span<std::byte> samples);

}  // namespace nacre
