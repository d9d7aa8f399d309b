#include "io/raw_volume.h"

#include <fmt/core.h>

#include <cmath>
#include <optional>

#include "core/error.h"
#include "io/bad_file.h"
#include "io/number_list.h"
#include "io/stored_samples.h"

namespace nacre {
namespace {

std::optional<ScalarType> parse_type(std::string_view text) {
  for (const ScalarType type :
       {ScalarType::U8, ScalarType::I8, ScalarType::U16, ScalarType::I16, ScalarType::U32,
        ScalarType::I32, ScalarType::F32, ScalarType::F64}) {
    if (name(type) == text) return type;
  }
  return std::nullopt;
}

std::optional<RawHeader> parse(std::string_view text) {
  const std::vector<std::string_view> parts = split(text, ',');
  if (parts.size() != 4 && parts.size() != 7) return std::nullopt;
  RawHeader header;
  for (int axis = 0; axis < 3; ++axis) {
    const auto count = parse_number<std::int64_t>(parts[static_cast<std::size_t>(axis)]);
    if (!count || *count < 1) return std::nullopt;
    header.dims[axis] = *count;
    if (parts.size() == 4) continue;
    const auto spacing = parse_number<double>(parts[4 + static_cast<std::size_t>(axis)]);
    if (!spacing || !std::isfinite(*spacing) || *spacing <= 0.0) return std::nullopt;
    header.spacing_mm[axis] = *spacing;
  }
  std::string_view type_name = parts[3];
  header.big_endian = type_name.ends_with("be");
  if (header.big_endian) type_name.remove_suffix(2);
  const std::optional<ScalarType> type = parse_type(type_name);
  if (!type) return std::nullopt;
  header.type = *type;
  return header;
}

}  // namespace

RawHeader parse_raw_header(std::string_view text) {
  const std::optional<RawHeader> header = parse(text);
  if (!header) {
    throw Error(
        ErrorCode::BadArgument,
        fmt::format("raw: found \"{}\", expected X,Y,Z,TYPE[,SX,SY,SZ]: counts from 1, TYPE "
                    "u8, i8, u16, i16, u32, i32, f32, f64 or one of them with be after it "
                    "(big endian), positive spacings in mm",
                    text));
  }
  return *header;
}

Volume read_raw(const std::filesystem::path& path, const RawHeader& header,
                VolumeReadReport& report) {
  report.format = "raw";
  const std::uint64_t found = file_size_of(path);
  std::uint64_t expected = size_of(header.type);
  bool too_large = false;
  for (int axis = 0; axis < 3; ++axis) {
    too_large |=
        __builtin_mul_overflow(expected, static_cast<std::uint64_t>(header.dims[axis]), &expected);
  }
  if (too_large || found != expected) {
    throw_bad_file(path, fmt::format("{} bytes", found),
                   fmt::format("{} x {} x {} samples of {} bytes{}", header.dims.x, header.dims.y,
                               header.dims.z, size_of(header.type),
                               too_large ? "" : fmt::format(", {} in all", expected)));
  }
  const StoredSamples stored{
      header.dims, static_cast<StoredType>(header.type), header.big_endian, {Stretch{path}}};
  Volume volume = read_stored_samples(path, stored, report);
  for (int axis = 0; axis < 3; ++axis) {
    volume.world_from_voxel[axis][axis] = header.spacing_mm[axis];
  }
  return volume;
}

}  // namespace nacre
