#include "io/draco_encode.h"

#include <draco/compression/encode.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstring>

#include "core/error.h"

namespace nacre {
namespace {

constexpr int kSlowest = 10;

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
  const glm::vec3 origin(grid.origin_mm);
  const int speed = kSlowest - std::clamp(compression, 0, kSlowest);
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method == DracoMethod::Sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                                              : draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetSpeedOptions(speed, speed);
  encoder.SetAttributeExplicitQuantization(draco::GeometryAttribute::POSITION, grid.bits, 3,
                                           &origin.x, static_cast<float>(grid.range_mm));
  encoder.SetTrackEncodedProperties(true);
  draco::Mesh input;
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
  result.counts = {encoder.num_encoded_faces(), encoder.num_encoded_points()};
  return result;
}

}  // namespace nacre
