#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string_view>

#include "core/volume.h"
#include "io/volume_read_report.h"

namespace nacre {

/// What a file of bare samples (x fastest) does not say itself.
struct RawHeader {
  glm::i64vec3 dims{0};
  ScalarType type = ScalarType::U8;
  bool big_endian = false;
  glm::dvec3 spacing_mm{1.0};  ///< positive
};

/// Parses "X,Y,Z,TYPE[,SX,SY,SZ]". TYPE is u8, i8, u16, i16, u32, i32, f32 or f64: little endian,
/// or big endian with "be" after it (u16be). Spacings in mm, 1 if left out.
/// @throws Error  BadArgument
RawHeader parse_raw_header(std::string_view text);

/// Reads a file of bare samples; first sample at the origin, axes along L, P, S.
/// @throws Error  BadFile if the file's size is not exactly that of the samples
Volume read_raw(const std::filesystem::path& path, const RawHeader& header,
                VolumeReadReport& report);

}  // namespace nacre
