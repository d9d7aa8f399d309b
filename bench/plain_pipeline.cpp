#include "bench/plain_pipeline.h"

#include <draco/compression/decode.h>
#include <draco/compression/encode.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#ifdef NACRE_HAVE_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif
#ifdef NACRE_HAVE_VTK
#include "bench/vtk_decimator.h"
#endif

namespace nacre {
namespace {

TriangleMesh by_openmesh(const TriangleMesh& surface, std::size_t triangles) {
  using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
  Mesh mesh;
  std::vector<Mesh::VertexHandle> vertices;
  for (const glm::vec3& p : surface.positions) {
    vertices.push_back(mesh.add_vertex(Mesh::Point(p.x, p.y, p.z)));
  }
  for (const glm::uvec3& t : surface.triangles) {
    mesh.add_face(vertices[t.x], vertices[t.y], vertices[t.z]);
  }
  OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
  OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  decimater.initialize();
  decimater.decimate_to_faces(0, triangles);
  mesh.garbage_collection();
  TriangleMesh result;
  for (const auto v : mesh.vertices()) {
    const Mesh::Point& p = mesh.point(v);
    result.positions.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto f : mesh.faces()) {
    glm::uvec3 t{};
    int corner = 0;
    for (const auto v : mesh.fv_range(f)) t[corner++] = static_cast<std::uint32_t>(v.idx());
    result.triangles.push_back(t);
  }
  return result;
}

#ifdef NACRE_HAVE_MESHOPTIMIZER
TriangleMesh by_meshoptimizer(const TriangleMesh& surface, std::size_t triangles) {
  constexpr float kAnyError = 1e9F;
  TriangleMesh result;
  if (surface.triangles.empty()) return result;
  const std::size_t indices = 3 * surface.triangles.size();
  std::vector<unsigned> kept(indices);
  kept.resize(meshopt_simplify(kept.data(), &surface.triangles.front().x, indices,
                               &surface.positions.front().x, surface.positions.size(),
                               sizeof(glm::vec3), 3 * triangles, kAnyError, 0, nullptr));
  result.positions.resize(surface.positions.size());
  const std::size_t used = meshopt_optimizeVertexFetch(result.positions.data(), kept.data(),
                                                       kept.size(), surface.positions.data(),
                                                       surface.positions.size(), sizeof(glm::vec3));
  result.positions.resize(used);
  for (std::size_t i = 0; i < kept.size(); i += 3) {
    result.triangles.emplace_back(kept[i], kept[i + 1], kept[i + 2]);
  }
  return result;
}
#endif

void fill(draco::Mesh& mesh, const TriangleMesh& surface) {
  const auto points = static_cast<std::uint32_t>(surface.positions.size());
  mesh.set_num_points(points);
  draco::GeometryAttribute layout;
  layout.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false,
              sizeof(glm::vec3), 0);
  draco::PointAttribute& attribute = *mesh.attribute(mesh.AddAttribute(layout, true, points));
  std::memcpy(attribute.GetAddress(draco::AttributeValueIndex(0)), surface.positions.data(),
              surface.positions.size() * sizeof(glm::vec3));
  for (const glm::uvec3& t : surface.triangles) {
    mesh.AddFace({draco::PointIndex(t.x), draco::PointIndex(t.y), draco::PointIndex(t.z)});
  }
}

void encode(const TriangleMesh& surface, int bits, draco::EncoderBuffer& buffer) {
  draco::Mesh mesh;
  fill(mesh, surface);
  draco::Encoder encoder;
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetSpeedOptions(0, 0);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
  if (!encoder.EncodeMeshToBuffer(mesh, &buffer).ok()) {
    throw std::runtime_error("Draco refuses a mesh");
  }
}

TriangleMesh decode(const draco::EncoderBuffer& bytes) {
  draco::DecoderBuffer input;
  input.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&input);
  if (!decoded.ok()) throw std::runtime_error("Draco does not read what it wrote");
  const draco::Mesh& mesh = *decoded.value();
  const draco::PointAttribute& attribute =
      *mesh.GetNamedAttribute(draco::GeometryAttribute::POSITION);
  TriangleMesh result;
  result.positions.resize(mesh.num_points());
  for (std::uint32_t i = 0; i < mesh.num_points(); ++i) {
    attribute.GetMappedValue(draco::PointIndex(i), &result.positions[i].x);
  }
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(i));
    result.triangles.emplace_back(face[0].value(), face[1].value(), face[2].value());
  }
  return result;
}

}  // namespace

std::vector<PlainDecimator> plain_decimators() {
  std::vector<PlainDecimator> decimators{{"OpenMesh", by_openmesh}};
#ifdef NACRE_HAVE_MESHOPTIMIZER
  decimators.push_back({"meshoptimizer", by_meshoptimizer});
#endif
#ifdef NACRE_HAVE_VTK
  decimators.push_back({"VTK", by_vtk});
#endif
  return decimators;
}

PlainMesh through_draco(const TriangleMesh& surface, int bits) {
  if (surface.triangles.empty()) return {};
  draco::EncoderBuffer buffer;
  encode(surface, bits, buffer);
  return {buffer.size(), decode(buffer)};
}

std::size_t draco_bytes(const TriangleMesh& surface, int bits) {
  if (surface.triangles.empty()) return 0;
  draco::EncoderBuffer buffer;
  encode(surface, bits, buffer);
  return buffer.size();
}

}  // namespace nacre
