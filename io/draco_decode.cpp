#include "io/draco_decode.h"

#include <draco/compression/decode.h>
#include <fmt/core.h>

#include <cmath>
#include <cstdint>
#include <memory>

#include "core/error.h"

namespace nacre {
namespace {

[[noreturn]] void reject(const std::string& what) { throw Error(ErrorCode::BadFile, what); }

std::unique_ptr<draco::Mesh> decoded(std::span<const std::byte> data) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(data.data()), data.size());
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok()) {
    reject(fmt::format("found compressed data that Draco refuses ({}), expected a mesh",
                       result.status().error_msg_string()));
  }
  return std::move(result).value();
}

void check_shape(const draco::Mesh& mesh, const draco::PointAttribute* positions,
                 const DracoCounts& expected) {
  if (mesh.num_faces() != expected.triangles || mesh.num_points() != expected.vertices) {
    reject(fmt::format("found {} triangles and {} vertices after decoding, expected {} and {}",
                       mesh.num_faces(), mesh.num_points(), expected.triangles, expected.vertices));
  }
  if (positions == nullptr || positions->data_type() != draco::DT_FLOAT32 ||
      positions->num_components() != 3) {
    reject("found no positions after decoding, expected three floats a vertex");
  }
}

std::vector<glm::vec3> positions_of(const draco::Mesh& mesh,
                                    const draco::PointAttribute& attribute) {
  std::vector<glm::vec3> positions(mesh.num_points());
  for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
    const draco::AttributeValueIndex value = attribute.mapped_index(point);
    if (value.value() >= attribute.size()) reject("found a vertex without position, expected one");
    glm::vec3& p = positions[point.value()];
    attribute.GetValue(value, &p.x);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      reject(fmt::format("found vertex {} at ({}, {}, {}), expected finite positions",
                         point.value(), p.x, p.y, p.z));
    }
  }
  return positions;
}

std::vector<glm::uvec3> triangles_of(const draco::Mesh& mesh) {
  std::vector<glm::uvec3> triangles(mesh.num_faces());
  for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
    const draco::Mesh::Face& corners = mesh.face(face);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t vertex = corners[static_cast<std::size_t>(i)].value();
      if (vertex >= mesh.num_points()) {
        reject(fmt::format("found vertex index {} in triangle {}, expected below {}", vertex,
                           face.value(), mesh.num_points()));
      }
      triangles[face.value()][i] = vertex;
    }
  }
  return triangles;
}

}  // namespace

TriangleMesh decode_draco(std::span<const std::byte> data, const DracoCounts& expected) {
  if (const auto objection = draco_objection(data, expected)) reject(*objection);
  const std::unique_ptr<draco::Mesh> mesh = decoded(data);
  const draco::PointAttribute* attribute =
      mesh->GetNamedAttribute(draco::GeometryAttribute::POSITION);
  check_shape(*mesh, attribute, expected);
  return {positions_of(*mesh, *attribute), triangles_of(*mesh)};
}

}  // namespace nacre
