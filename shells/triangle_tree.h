#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/triangle_mesh.h"

namespace nacre {

/// Three corners of a triangle or of a part of one.
using TriangleCorners = std::array<glm::dvec3, 3>;

/// The triangles of a surface in a tree of boxes, to find those near a point.
class TriangleTree {
 public:
  /// @param mesh  must outlive the tree
  explicit TriangleTree(const TriangleMesh& mesh);

  /// Distance of a point to the nearest triangle; `within` if none is nearer than that.
  double distance(const glm::dvec3& p, double within) const;

  /// The least r such that one triangle of the tree has all three corners within r of it; `within`
  /// if no triangle does better than that; stops early once r <= `enough`.
  ///
  /// The distance to a triangle is convex, so that no point of the given triangle is farther from
  /// this surface than r.
  double cover_radius(const TriangleCorners& corners, double within, double enough) const;

 private:
  struct Node {
    glm::vec3 lo;
    glm::vec3 hi;
    std::uint32_t begin;  ///< of the node's triangles in `order_`
    std::uint32_t end;
    std::uint32_t right;  ///< second child, the first is the next node; 0 in a leaf
  };

  std::uint32_t build(std::uint32_t begin, std::uint32_t end, std::vector<glm::vec3>& centers);
  void enclose(Node& node) const;
  double squared_distance(const Node& node, const glm::dvec3& p) const;
  /// Visits leaves in order of their distance to `p` as long as `squared_limit()` exceeds it.
  template <class Limit, class Visit>
  void near(const glm::dvec3& p, Limit&& squared_limit, Visit&& visit) const;

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace nacre
