#include "shells/simplify.h"

// OpenMesh prints what it dislikes; nothing here gives it reason to.
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <cassert>
#include <cfloat>
#include <vector>

#include "shells/closed_mesh.h"
#include "shells/collapse_guard.h"

namespace nacre {
namespace {

using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
using OpenMesh::Decimater::ModQuadricT;

glm::dvec3 to_glm(const OpenMesh::Vec3f& p) { return {p[0], p[1], p[2]}; }

/// Quadric priority, for collapses that the guard allows.
///
/// The guard costs far more than the quadric, and the decimater asks for all edges of a vertex but
/// uses the best: an edge that is no better than one already allowed is refused unseen.
template <class MeshT>
class GuardedQuadricT : public ModQuadricT<MeshT> {
 public:
  DECIMATING_MODULE(GuardedQuadricT, MeshT, GuardedQuadric);

  explicit GuardedQuadricT(MeshT& mesh) : ModQuadricT<MeshT>(mesh) {}

  void set_guard(CollapseGuard& guard) { guard_ = &guard; }

  float collapse_priority(const CollapseInfo& info) override {
    // Rounding makes small errors negative, which would mean "never".
    const float priority = std::max(ModQuadricT<MeshT>::collapse_priority(info), 0.0f);
    if (info.v0 != asked_vertex_ || collapses_ != asked_after_) {
      asked_vertex_ = info.v0;
      asked_after_ = collapses_;
      best_ = FLT_MAX;
    }
    if (priority >= best_) return Base::ILLEGAL_COLLAPSE;
    describe(info);
    if (!guard_->allows(move_)) return Base::ILLEGAL_COLLAPSE;
    best_ = priority;
    return priority;
  }

  void preprocess_collapse(const CollapseInfo& info) override {
    describe(info);
    guard_->commit(move_);
    ++collapses_;
  }

 private:
  void describe(const CollapseInfo& info) {
    const MeshT& mesh = Base::mesh();
    move_.before = to_glm(info.p0);
    move_.after = to_glm(info.p1);
    move_.kept.clear();
    move_.removed.clear();
    for (auto spoke = mesh.cvoh_iter(info.v0); spoke.is_valid(); ++spoke) {
      const auto across = mesh.next_halfedge_handle(*spoke);
      const auto a = mesh.from_vertex_handle(across);
      const auto b = mesh.to_vertex_handle(across);
      const FanTriangle triangle{to_glm(mesh.point(a)), to_glm(mesh.point(b)),
                                 static_cast<std::uint32_t>(mesh.face_handle(*spoke).idx())};
      (a == info.v1 || b == info.v1 ? move_.removed : move_.kept).push_back(triangle);
    }
  }

  CollapseGuard* guard_ = nullptr;
  FanMove move_;
  typename MeshT::VertexHandle asked_vertex_;
  std::size_t collapses_ = 0;
  std::size_t asked_after_ = 0;
  float best_ = FLT_MAX;
};

Mesh to_openmesh(const TriangleMesh& surface) {
  // Checks the surface, and gives vertices where sheets touch a number each.
  const ClosedMesh closed(surface.triangles, surface.positions.size());
  Mesh mesh;
  mesh.reserve(closed.vertex_count(), closed.half_edge_count() / 2, closed.triangle_count());
  for (std::uint32_t v = 0; v < closed.vertex_count(); ++v) {
    const glm::vec3& p = surface.positions[closed.source(v)];
    mesh.add_vertex({p.x, p.y, p.z});
  }
  for (std::size_t t = 0; t < closed.triangle_count(); ++t) {
    const glm::uvec3 corners = closed.triangle(t);
    const auto vertex = [&](int i) { return mesh.vertex_handle(corners[i]); };
    mesh.add_face(vertex(0), vertex(1), vertex(2));
  }
  assert(mesh.n_faces() == closed.triangle_count());
  return mesh;
}

TriangleMesh from_openmesh(Mesh& mesh) {
  mesh.garbage_collection();
  TriangleMesh surface;
  surface.positions.reserve(mesh.n_vertices());
  for (const auto vertex : mesh.vertices()) {
    const OpenMesh::Vec3f& p = mesh.point(vertex);
    surface.positions.emplace_back(p[0], p[1], p[2]);
  }
  surface.triangles.reserve(mesh.n_faces());
  for (const auto face : mesh.faces()) {
    glm::uvec3 corners;
    int i = 0;
    for (auto corner = mesh.cfv_iter(face); corner.is_valid(); ++corner) {
      corners[i++] = static_cast<std::uint32_t>(corner->idx());
    }
    surface.triangles.push_back(corners);
  }
  return surface;
}

void add_faces(CollapseGuard& guard, const Mesh& mesh) {
  for (const auto face : mesh.faces()) {
    auto corner = mesh.cfv_iter(face);
    const glm::dvec3 a = to_glm(mesh.point(*corner++));
    const glm::dvec3 b = to_glm(mesh.point(*corner++));
    guard.add_face(static_cast<std::uint32_t>(face.idx()), a, b, to_glm(mesh.point(*corner)));
  }
}

}  // namespace

TriangleMesh simplify(const TriangleMesh& surface, const SimplifyOptions& options) {
  const bool is_bounded = options.tolerance_mm > 0.0 || options.error;
  const bool is_small = surface.triangles.size() <= options.target_triangles;
  if (surface.triangles.empty() || is_small || (!is_bounded && options.target_triangles == 0)) {
    return surface;
  }
  Mesh mesh = to_openmesh(surface);
  CollapseGuard guard(options, mesh.n_faces());
  add_faces(guard, mesh);
  OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
  GuardedQuadricT<Mesh>::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).set_guard(guard);
  decimater.module(quadric).unset_max_err();
  decimater.initialize();
  decimater.decimate_to_faces(0, options.target_triangles);
  return from_openmesh(mesh);
}

}  // namespace nacre
