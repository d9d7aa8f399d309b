#include "io/draco_encode.h"

#include <draco/compression/encode.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>

#include "core/error.h"
#include "core/quantization_grid.h"

namespace nacre {
namespace {

/// Draco's parameters of a quantised attribute as they stand in its bytes.
struct Quantization {
  glm::vec3 origin;
  float range;
  std::uint8_t bits;

  static constexpr std::size_t kBytes = 3 * sizeof(float) + sizeof(float) + 1;

  std::array<std::byte, kBytes> bytes() const {
    static_assert(std::endian::native == std::endian::little);
    std::array<std::byte, kBytes> result;
    std::memcpy(result.data(), &origin, sizeof(origin));
    std::memcpy(result.data() + sizeof(origin), &range, sizeof(range));
    result.back() = std::byte{bits};
    return result;
  }
};

/// A grid's parameters, lengths divided by a unit.
Quantization in_units(const QuantizationGrid& grid, double unit) {
  return {glm::vec3(grid.origin_mm / unit), static_cast<float>(grid.range_mm / unit),
          static_cast<std::uint8_t>(grid.bits)};
}

/// Writes a grid's parameters, the last thing in the bytes, in place of those in other units.
///
/// @throws Error  Unsupported if those are not what the bytes end with
void replace_quantization(std::span<std::byte> bytes, const Quantization& encoded,
                          const Quantization& meant) {
  const auto found = encoded.bytes();
  if (bytes.size() < found.size() || !std::ranges::equal(bytes.last(found.size()), found)) {
    throw Error(ErrorCode::Unsupported,
                "found Draco bytes that end otherwise than with their quantisation, expected those "
                "of version 2.2");
  }
  std::ranges::copy(meant.bytes(), bytes.last(found.size()).begin());
}

/// Fills a Draco mesh, which can be neither moved nor copied.
void fill(draco::Mesh& result, const TriangleMesh& mesh) {
  const auto points = static_cast<std::uint32_t>(mesh.positions.size());
  result.set_num_points(points);
  draco::GeometryAttribute layout;
  layout.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false,
              sizeof(glm::vec3), 0);
  const int id = result.AddAttribute(layout, true, points);
  draco::PointAttribute& attribute = *result.attribute(id);
  std::memcpy(attribute.GetAddress(draco::AttributeValueIndex(0)), mesh.positions.data(),
              mesh.positions.size() * sizeof(glm::vec3));
  result.SetNumFaces(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    result.SetFace(draco::FaceIndex(static_cast<std::uint32_t>(i)),
                   {draco::PointIndex(t.x), draco::PointIndex(t.y), draco::PointIndex(t.z)});
  }
}

}  // namespace

DracoData encode_draco(TriangleMesh&& mesh, const QuantizationGrid& grid, int compression,
                       DracoMethod method) {
  // The encoder passes its parameters on as decimals, six behind the point: right for integers, an
  // ulp or more off for other floats below 16. In units of the grid all is an integer.
  const double unit = unit_mm(grid);
  const Quantization in_integers = in_units(grid, unit);
  constexpr int kSlowest = 10;
  const int speed = kSlowest - std::clamp(compression, 0, kSlowest);
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method == DracoMethod::Sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                                              : draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetSpeedOptions(speed, speed);
  encoder.SetAttributeExplicitQuantization(draco::GeometryAttribute::POSITION, grid.bits, 3,
                                           &in_integers.origin.x, in_integers.range);
  encoder.SetTrackEncodedProperties(true);
  draco::Mesh input;
  for (glm::vec3& p : mesh.positions) p = glm::vec3(glm::dvec3(p) / unit);
  fill(input, mesh);
  mesh = {};
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeMeshToBuffer(input, &buffer);
  if (!status.ok()) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("found a shell of {} triangles that Draco refuses ({}), expected one "
                            "it compresses",
                            input.num_faces(), status.error_msg_string()));
  }
  DracoData result;
  const auto* begin = reinterpret_cast<const std::byte*>(buffer.data());
  result.bytes.assign(begin, begin + buffer.size());
  replace_quantization(result.bytes, in_integers, in_units(grid, 1.0));
  result.counts = {encoder.num_encoded_faces(), encoder.num_encoded_points()};
  return result;
}

}  // namespace nacre
