#include "io/openmesh_reader.h"

#include <fmt/core.h>

#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/IO/reader/OBJReader.hh>
#include <OpenMesh/Core/IO/reader/OFFReader.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <OpenMesh/Core/IO/reader/STLReader.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <cmath>
#include <locale>
#include <sstream>
#include <vector>

#include "io/bad_file.h"

namespace nacre {
namespace {

namespace om = OpenMesh;

/// Takes vertices and faces from a reader of OpenMesh as they come, and nothing else.
class MeshCollector final : public om::IO::BaseImporter {
 public:
  om::VertexHandle add_vertex(const om::Vec3f& point) override {
    mesh.positions.emplace_back(point[0], point[1], point[2]);
    return om::VertexHandle(static_cast<int>(mesh.positions.size()) - 1);
  }
  om::VertexHandle add_vertex() override { return add_vertex(om::Vec3f(0.0F)); }
  void set_point(om::VertexHandle vertex, const om::Vec3f& point) override {
    mesh.positions[static_cast<std::size_t>(vertex.idx())] = {point[0], point[1], point[2]};
  }
  om::FaceHandle add_face(const VHandles& corners) override {
    const auto index = [&](std::size_t i) { return static_cast<glm::uint>(corners[i].idx()); };
    for (std::size_t i = 2; i < corners.size(); ++i) {
      mesh.triangles.emplace_back(index(0), index(i - 1), index(i));
    }
    return om::FaceHandle(static_cast<int>(faces++));
  }
  std::size_t n_vertices() const override { return mesh.positions.size(); }
  std::size_t n_faces() const override { return faces; }

  // What a tool has no use for.
  std::size_t n_edges() const override { return 0; }
  om::HalfedgeHandle add_edge(om::VertexHandle, om::VertexHandle) override {
    return om::HalfedgeHandle();
  }
  om::FaceHandle add_face(om::HalfedgeHandle) override { return om::FaceHandle(); }
  void add_face_texcoords(om::FaceHandle, om::VertexHandle,
                          const std::vector<om::Vec2f>&) override {}
  void add_face_texcoords(om::FaceHandle, om::VertexHandle,
                          const std::vector<om::Vec3f>&) override {}
  void set_face_texindex(om::FaceHandle, int) override {}
  void set_halfedge(om::VertexHandle, om::HalfedgeHandle) override {}
  void set_normal(om::VertexHandle, const om::Vec3f&) override {}
  void set_normal(om::VertexHandle, const om::Vec3d&) override {}
  void set_normal(om::FaceHandle, const om::Vec3f&) override {}
  void set_normal(om::FaceHandle, const om::Vec3d&) override {}
  void set_color(om::VertexHandle, const om::Vec3uc&) override {}
  void set_color(om::VertexHandle, const om::Vec4uc&) override {}
  void set_color(om::VertexHandle, const om::Vec3f&) override {}
  void set_color(om::VertexHandle, const om::Vec4f&) override {}
  void set_color(om::EdgeHandle, const om::Vec3uc&) override {}
  void set_color(om::EdgeHandle, const om::Vec4uc&) override {}
  void set_color(om::EdgeHandle, const om::Vec3f&) override {}
  void set_color(om::EdgeHandle, const om::Vec4f&) override {}
  void set_color(om::FaceHandle, const om::Vec3uc&) override {}
  void set_color(om::FaceHandle, const om::Vec4uc&) override {}
  void set_color(om::FaceHandle, const om::Vec3f&) override {}
  void set_color(om::FaceHandle, const om::Vec4f&) override {}
  void set_texcoord(om::VertexHandle, const om::Vec2f&) override {}
  void set_texcoord(om::VertexHandle, const om::Vec3f&) override {}
  void set_texcoord(om::HalfedgeHandle, const om::Vec2f&) override {}
  void set_texcoord(om::HalfedgeHandle, const om::Vec3f&) override {}
  void set_status(om::VertexHandle, const om::Attributes::StatusInfo&) override {}
  void set_status(om::HalfedgeHandle, const om::Attributes::StatusInfo&) override {}
  void set_status(om::EdgeHandle, const om::Attributes::StatusInfo&) override {}
  void set_status(om::FaceHandle, const om::Attributes::StatusInfo&) override {}
  void set_next(om::HalfedgeHandle, om::HalfedgeHandle) override {}
  void set_face(om::HalfedgeHandle, om::FaceHandle) override {}
  void request_face_texcoords2D() override {}
  void add_texture_information(int, std::string) override {}

  TriangleMesh mesh;
  std::size_t faces = 0;
};

/// Keeps OpenMesh from printing, as long as it lives.
class Silence {
 public:
  Silence() {
    for (om::mostream* stream : streams()) {
      if (stream->is_enabled()) enabled_.push_back(stream);
      stream->disable();
    }
  }
  ~Silence() {
    for (om::mostream* stream : enabled_) stream->enable();
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  static std::vector<om::mostream*> streams() { return {&omlog(), &omout(), &omerr()}; }

  std::vector<om::mostream*> enabled_;
};

om::IO::BaseReader& reader_of(MeshFormat format) {
  switch (format) {
    case MeshFormat::Stl: return om::IO::STLReader();
    case MeshFormat::Obj: return om::IO::OBJReader();
    case MeshFormat::Ply: return om::IO::PLYReader();
    case MeshFormat::Off: break;
  }
  return om::IO::OFFReader();
}

void check_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw_bad_file(path, fmt::format("NaN or infinity in vertex {}", i + 1), "finite vertices");
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& corners = mesh.triangles[i];
    for (int k = 0; k < 3; ++k) {
      if (corners[k] >= mesh.positions.size()) {
        throw_bad_file(
            path,
            fmt::format("vertex {} in triangle {}", static_cast<std::int32_t>(corners[k]), i + 1),
            fmt::format("0 to {}", mesh.positions.size() - 1));
      }
    }
  }
}

}  // namespace

TriangleMesh read_with_openmesh(const std::filesystem::path& path, MeshFormat format,
                                PlainMesh plain) {
  MeshCollector collector;
  std::istringstream stream(std::move(plain.bytes), std::ios::in | std::ios::binary);
  stream.imbue(std::locale::classic());
  om::IO::Options options = plain.binary ? om::IO::Options::Binary : om::IO::Options::Default;
  const Silence silence;
  const bool read = reader_of(format).read(stream, collector, options);
  const bool stl = format == MeshFormat::Stl;
  if (!read || (!stl && collector.mesh.positions.size() != plain.vertices) ||
      (stl ? collector.faces > plain.faces : collector.faces != plain.faces)) {
    throw_bad_file(path,
                   fmt::format("{} vertices and {} faces that OpenMesh reads",
                               collector.mesh.positions.size(), collector.faces),
                   stl ? fmt::format("{} faces", plain.faces)
                       : fmt::format("{} and {}", plain.vertices, plain.faces));
  }
  check_mesh(path, collector.mesh);
  return std::move(collector.mesh);
}

}  // namespace nacre
