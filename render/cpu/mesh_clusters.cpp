#include "render/cpu/mesh_clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render/scene_facts.h"

namespace nacre {
namespace {

constexpr std::uint32_t kMortonCells = 1024;  // a side: ten bits of each axis

/// Spreads ten bits so that two zeros follow each.
std::uint32_t spread_bits(std::uint32_t bits) {
  bits = (bits | (bits << 16U)) & 0x030000FFU;
  bits = (bits | (bits << 8U)) & 0x0300F00FU;
  bits = (bits | (bits << 4U)) & 0x030C30C3U;
  return (bits | (bits << 2U)) & 0x09249249U;
}

struct KeyedTriangle {
  std::uint32_t key;
  std::uint32_t triangle;
};

std::vector<KeyedTriangle> morton_keys(const TriangleMesh& mesh) {
  const Box bounds = bounds_of(mesh.positions);
  const glm::vec3 lo(bounds.lo);
  const glm::vec3 size = glm::vec3(bounds.hi) - lo;
  // Cubic cells: compact clusters whatever the shape of the bounds.
  const float cells =
      static_cast<float>(kMortonCells - 1) / (3.0F * std::max({size.x, size.y, size.z, 1e-30F}));
  std::vector<KeyedTriangle> keyed(mesh.triangles.size());
  for (std::size_t t = 0; t < keyed.size(); ++t) {
    const glm::uvec3& corner = mesh.triangles[t];
    const glm::vec3 sum =
        mesh.positions[corner.x] + mesh.positions[corner.y] + mesh.positions[corner.z];
    const glm::uvec3 cell((sum - 3.0F * lo) * cells);
    keyed[t] = {spread_bits(cell.x) | (spread_bits(cell.y) << 1U) | (spread_bits(cell.z) << 2U),
                static_cast<std::uint32_t>(t)};
  }
  return keyed;
}

/// Sorts by key, keeping the order of equal ones: three counting passes of ten bits.
void sort_by_key(std::vector<KeyedTriangle>& keyed) {
  std::vector<KeyedTriangle> other(keyed.size());
  for (unsigned shift = 0; shift < 30; shift += 10) {
    std::array<std::size_t, kMortonCells> start{};
    const auto digit = [&](const KeyedTriangle& item) {
      return (item.key >> shift) & (kMortonCells - 1);
    };
    for (const KeyedTriangle& item : keyed) ++start[digit(item)];
    std::size_t sum = 0;
    for (std::size_t& entry : start) {
      const std::size_t count = entry;
      entry = sum;
      sum += count;
    }
    for (const KeyedTriangle& item : keyed) other[start[digit(item)]++] = item;
    keyed.swap(other);
  }
}

/// 128 triangles span 8 edges of a flat surface.
constexpr double kReachEdges = 24.0;

/// Gathers triangles until a cluster is full.
class ClusterBuilder {
 public:
  ClusterBuilder(const TriangleMesh& mesh, double most_mm, MeshClusters& result)
      : mesh_(mesh),
        result_(result),
        local_(mesh.positions.size(), kNone),
        reach_mm_(static_cast<float>(std::min(kReachEdges * mean_edge_mm(mesh), 0.5 * most_mm))) {}

  void add(std::uint32_t triangle) {
    const glm::uvec3& corners = mesh_.triangles[triangle];
    std::size_t fresh = 0;
    for (int i = 0; i < 3; ++i) fresh += local_[corners[i]] == kNone ? 1 : 0;
    if (triangles_.size() == kClusterTriangles || vertices_.size() + fresh > kClusterVertices ||
        is_far(corners)) {
      finish();
    }
    std::array<std::uint8_t, 3> local{};
    for (int i = 0; i < 3; ++i) {
      std::uint8_t& place = local_[corners[i]];
      if (place == kNone) {
        place = static_cast<std::uint8_t>(vertices_.size());
        vertices_.push_back(corners[i]);
      }
      local[static_cast<std::size_t>(i)] = place;
    }
    triangles_.push_back(local);
  }

  void finish() {
    if (triangles_.empty()) return;
    Cluster cluster;
    set_bounds(cluster);
    set_cone(cluster);
    copy_vertices(cluster);
    copy_triangles(cluster);
    result_.clusters.push_back(cluster);
    for (const std::uint32_t vertex : vertices_) local_[vertex] = kNone;
    vertices_.clear();
    triangles_.clear();
  }

 private:
  static constexpr std::uint8_t kNone = 255;
  static_assert(kClusterVertices < kNone);

  /// Whether a triangle lies away from the cluster: more than the cluster would span if it were
  /// whole.
  bool is_far(const glm::uvec3& corners) const {
    if (triangles_.empty()) return false;
    const glm::vec3 away =
        glm::abs(mesh_.positions[corners.x] - mesh_.positions[vertices_.front()]);
    return std::max({away.x, away.y, away.z}) > reach_mm_;
  }

  const glm::vec3& position(std::uint8_t local) const { return mesh_.positions[vertices_[local]]; }

  void set_bounds(Cluster& cluster) const {
    glm::vec3 lo = position(0);
    glm::vec3 hi = lo;
    for (const std::uint32_t vertex : vertices_) {
      lo = glm::min(lo, mesh_.positions[vertex]);
      hi = glm::max(hi, mesh_.positions[vertex]);
    }
    cluster.center_mm = 0.5F * (lo + hi);
    // Half a millionth more: the box's centre is rounded.
    cluster.extent_mm = 0.5F * (hi - lo) + 1e-6F * (glm::abs(lo) + glm::abs(hi));
  }

  void set_cone(Cluster& cluster) const {
    std::vector<glm::vec3> normals;
    glm::vec3 sum(0.0F);
    for (const auto& [a, b, c] : triangles_) {
      // In double: fourth powers of lengths, in any unit, and of slivers the way they face.
      const glm::dvec3 from(position(a));
      const glm::dvec3 normal =
          glm::cross(glm::dvec3(position(b)) - from, glm::dvec3(position(c)) - from);
      const double length = glm::length(normal);
      if (!(length > 0.0)) continue;
      normals.emplace_back(normal / length);
      sum += normals.back();
    }
    const float length = glm::length(sum);
    if (!(length > 0.0F)) return;
    cluster.cone_axis = sum / length;
    float cosine = 1.0F;
    for (const glm::vec3& normal : normals) {
      cosine = std::min(cosine, glm::dot(cluster.cone_axis, normal));
    }
    if (cosine > 0.0F) cluster.cone_sine = std::sqrt(1.0F - cosine * cosine) + 1e-3F;
  }

  void copy_vertices(Cluster& cluster) {
    const std::size_t count = padded(vertices_.size());
    cluster.vertices = static_cast<std::uint16_t>(count);
    cluster.first_position = static_cast<std::uint32_t>(result_.positions.size());
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t vertex = std::min(i, vertices_.size() - 1);
        result_.positions.push_back(mesh_.positions[vertices_[vertex]][axis]);
      }
    }
  }

  void copy_triangles(Cluster& cluster) {
    const std::size_t count = padded(triangles_.size());
    cluster.triangles = static_cast<std::uint16_t>(count);
    cluster.first_corner = static_cast<std::uint32_t>(result_.corners.size());
    for (std::size_t corner = 0; corner < 3; ++corner) {
      for (const auto& triangle : triangles_) result_.corners.push_back(triangle[corner]);
      result_.corners.resize(result_.corners.size() + count - triangles_.size(), 0);
    }
  }

  static std::size_t padded(std::size_t count) {
    return (count + kLanePadding - 1) / kLanePadding * kLanePadding;
  }

  const TriangleMesh& mesh_;
  MeshClusters& result_;
  std::vector<std::uint8_t> local_;  // of each vertex in the cluster being filled
  float reach_mm_;
  std::vector<std::uint32_t> vertices_;
  std::vector<std::array<std::uint8_t, 3>> triangles_;
};

}  // namespace

std::size_t MeshClusters::bytes() const noexcept {
  return clusters.size() * sizeof(Cluster) + positions.size() * sizeof(float) + corners.size();
}

double mean_edge_mm(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    sum += glm::distance(mesh.positions[t.x], mesh.positions[t.y]);
  }
  return sum / static_cast<double>(mesh.triangles.size());
}

MeshClusters cluster_mesh(const TriangleMesh& mesh, double most_mm) {
  MeshClusters result;
  result.triangles = mesh.triangles.size();
  if (mesh.triangles.empty()) return result;
  std::vector<KeyedTriangle> keyed = morton_keys(mesh);
  sort_by_key(keyed);
  result.corners.reserve(3 * keyed.size() + keyed.size() / 4);
  result.positions.reserve(2 * keyed.size() + keyed.size() / 4);
  ClusterBuilder builder(mesh, most_mm, result);
  for (const KeyedTriangle& item : keyed) builder.add(item.triangle);
  builder.finish();
  return result;
}

}  // namespace nacre
