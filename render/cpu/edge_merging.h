#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/triangle_mesh.h"

namespace nacre {

/// Vertices of a surface merged into one: their box, and the squared distance from the planes of
/// the triangles around them, weighed by areas, as a quadric x'Ax - 2b'x + c of positions relative
/// to the middle of the box (Garland, Heckbert 1997, "Surface Simplification Using Quadric Error
/// Metrics", section 4). A cache line; relative, floats are enough.
///
/// @tparam Number  float, or a vector of floats: as many groups side by side
template <class Number>
struct alignas(64) VertexGroup {
  Number lo_x{}, lo_y{}, lo_z{}, hi_x{}, hi_y{}, hi_z{};
  Number xx{}, xy{}, xz{}, yy{}, yz{}, zz{};  ///< A; its trace is the area of the triangles
  Number b_x{}, b_y{}, b_z{}, c{};
};

/// A closed surface whose vertices are merged in pairs along its edges, those first that stay
/// nearest to the planes around them, and each to the point nearest to these: a mean would make
/// what is thin thinner.
///
/// What is left is closed as a chain: every edge is shared by as many triangles one way as the
/// other, so front and back faces still cover the same pixels.
///
/// Groups are kept in a frame of their own, the surface's times a power of two, so that the unit
/// makes no difference: products of six lengths would leave a float's range.
class EdgeMerging {
 public:
  explicit EdgeMerging(const TriangleMesh& mesh);

  /// Merges each vertex with at most one other. None of the surface's goes further than `reach_mm`
  /// from where it was; what would, or would go more than a tenth of that from the planes around it
  /// in the mean, stays.
  ///
  /// About 100 ns a triangle of `mesh()`. Memory is 94 bytes a triangle of the surface at most: 58
  /// are kept, 32 of them as groups, and 36 are pairs while they are sorted.
  void merge_pairs(double reach_mm);

  const TriangleMesh& mesh() const { return mesh_; }

  /// How far a vertex of the surface went at most, and with it, as triangles are flat, any point.
  double farthest_mm() const;

 private:
  /// An edge, and what it costs to merge its ends.
  struct Pair {
    std::uint32_t key;  ///< the bits of the cost: of floats that are not negative they sort alike
    std::uint32_t first;
    std::uint32_t second;
  };

  // Reaches of these are in the frame of the groups.
  std::vector<Pair> pairs_within(float reach) const;
  std::vector<std::uint32_t> partners_within(float reach) const;
  std::vector<std::uint32_t> merge_groups(const std::vector<std::uint32_t>& partners, float reach);
  void renumber(const std::vector<std::uint32_t>& numbers);
  static void sort_by_key(std::vector<Pair>& pairs);

  std::vector<glm::vec3> positions_;      // of the surface
  std::vector<std::uint32_t> merged_to_;  // of each of those: its index in `mesh_`
  TriangleMesh mesh_;
  float frame_from_mm_;
  std::vector<VertexGroup<float>> groups_;  // one a vertex of `mesh_`
};

}  // namespace nacre
