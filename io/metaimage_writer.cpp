#include "io/metaimage_writer.h"

#include <fmt/core.h>

#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <string>

#include "core/error.h"
#include "io/atomic_file.h"

namespace nacre {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const char* type_name(ScalarType type) {
  switch (type) {
    case ScalarType::U8: return "MET_UCHAR";
    case ScalarType::I8: return "MET_CHAR";
    case ScalarType::U16: return "MET_USHORT";
    case ScalarType::I16: return "MET_SHORT";
    case ScalarType::U32: return "MET_UINT";
    case ScalarType::I32: return "MET_INT";
    case ScalarType::F32: return "MET_FLOAT";
    case ScalarType::F64: break;
  }
  return "MET_DOUBLE";
}

/// A column of world_from_voxel as the format wants it: spacing * direction.
struct Axis {
  double spacing = 1.0;
  glm::dvec3 direction{0.0};
};

/// A direction whose product with the spacing rounds to exactly the column; false if there is none.
bool has_exact_direction(const glm::dvec3& column, Axis& axis) {
  for (int row = 0; row < 3; ++row) {
    const double quotient = column[row] / axis.spacing;
    bool found = false;
    for (const double toward : {quotient, -kInfinity, kInfinity}) {
      axis.direction[row] = std::nextafter(quotient, toward);
      found = axis.spacing * axis.direction[row] == column[row];
      if (found) break;
    }
    if (!found) return false;
  }
  return true;
}

/// Splits a column into length and direction so that the product gives it back to the last bit.
///
/// For the rounded length alone some component may miss by one unit in the last place; of the
/// neighbouring lengths about every third has a direction that hits all three.
Axis split(const glm::dvec3& column) {
  Axis axis{glm::length(column), {}};
  if (has_exact_direction(column, axis)) return axis;
  double below = axis.spacing;
  double above = axis.spacing;
  for (int attempt = 0; attempt < 1000; ++attempt) {
    below = std::nextafter(below, 0.0);
    above = std::nextafter(above, kInfinity);
    for (const double spacing : {below, above}) {
      axis.spacing = spacing;
      if (has_exact_direction(column, axis)) return axis;
    }
  }
  axis.spacing = glm::length(column);
  axis.direction = column / axis.spacing;
  return axis;
}

std::string header_text(const Volume& volume, const std::string& data_file) {
  const glm::dmat4& m = volume.world_from_voxel;
  const std::array<Axis, 3> axes{split(glm::dvec3(m[0])), split(glm::dvec3(m[1])),
                                 split(glm::dvec3(m[2]))};
  std::string text = "ObjectType = Image\nNDims = 3\nBinaryData = True\n";
  text += fmt::format("BinaryDataByteOrderMSB = {}\nCompressedData = False\n",
                      std::endian::native == std::endian::big ? "True" : "False");
  text += "TransformMatrix =";
  for (const Axis& axis : axes) {
    text += fmt::format(" {} {} {}", axis.direction.x, axis.direction.y, axis.direction.z);
  }
  text += fmt::format("\nOffset = {} {} {}\n", m[3].x, m[3].y, m[3].z);
  text +=
      fmt::format("ElementSpacing = {} {} {}\n", axes[0].spacing, axes[1].spacing, axes[2].spacing);
  text += fmt::format("DimSize = {} {} {}\n", volume.dims.x, volume.dims.y, volume.dims.z);
  if (volume.slope != 1.0 || volume.intercept != 0.0) {
    text +=
        fmt::format("ElementToIntensityFunctionSlope = {}\nElementToIntensityFunctionOffset = {}\n",
                    volume.slope, volume.intercept);
  }
  text +=
      fmt::format("ElementType = {}\nElementDataFile = {}\n", type_name(volume.type), data_file);
  return text;
}

}  // namespace

void write_metaimage(const Volume& volume, const std::filesystem::path& path) {
  for (int axis = 0; axis < 3; ++axis) {
    if (volume.dims[axis] > std::numeric_limits<int>::max()) {
      throw Error(ErrorCode::Unsupported,
                  fmt::format("{}: found {} samples along an axis, expected less than 2^31",
                              path.string(), volume.dims[axis]));
    }
  }
  const std::span<const std::byte> samples(volume.samples.data(), volume.samples.size());
  const bool detached = path.extension() == ".mhd" || path.extension() == ".MHD";
  AtomicFile file(path);
  if (detached) {
    const std::filesystem::path raw_path = std::filesystem::path(path).replace_extension(".raw");
    AtomicFile raw(raw_path);
    raw.write(samples);
    file.write(header_text(volume, raw_path.filename().string()));
    raw.commit();
  } else {
    file.write(header_text(volume, "LOCAL"));
    file.write(samples);
  }
  file.commit();
}

}  // namespace nacre
