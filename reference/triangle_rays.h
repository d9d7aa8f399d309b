#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/camera.h"
#include "core/picture.h"
#include "reference/triangle_crossing.h"

namespace nacre {

/// A crossing of one of many triangles.
struct TriangleHit : TriangleCrossing {
  std::uint32_t triangle = 0;  ///< index into the triangles given
};

/// Rays against triangles, in double: a bounding volume hierarchy over watertight crossings.
///
/// What is found is what testing every triangle with `crossing` would find, to the last bit: boxes
/// are widened by more than rounding can move a crossing. Any triangles will do: open,
/// non-manifold, overlapping; those without area are never crossed.
///
/// Building takes O(n log n), in parallel: splits by the surface area heuristic in 16 bins (Wald
/// 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies"); the same tree for any
/// number of threads. Safe to use from many threads.
class TriangleRays {
 public:
  /// @param positions_mm  LPS mm, finite
  /// @param triangles     three indices into them each
  TriangleRays(std::vector<glm::dvec3> positions_mm, std::span<const glm::uvec3> triangles);

  /// The first crossing with t in the interval, ends included; of several at the same t, the one
  /// with the lowest triangle.
  std::optional<TriangleHit> nearest(const Ray& ray, const RayInterval& interval = {}) const;

  /// All crossings with t in the interval, ends included, by ascending t, then triangle.
  std::vector<TriangleHit> all(const Ray& ray, const RayInterval& interval = {}) const;

  /// The corners of a triangle, LPS mm.
  std::array<glm::dvec3, 3> corners(std::uint32_t triangle) const;

 private:
  struct Box {
    glm::dvec3 lo{std::numeric_limits<double>::infinity()};
    glm::dvec3 hi{-std::numeric_limits<double>::infinity()};
  };
  /// A leaf has `count` triangles from `first` in `order_`; an inner node has its left child right
  /// behind itself and its right child at `first`.
  struct Node {
    Box box;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  class Builder;
  class LineBoxTest;

  /// Calls `visit(hit)` with the crossings in nodes that may hold any in the interval, which it may
  /// shorten.
  template <class Visit>
  void traverse(const Ray& ray, RayInterval& interval, Visit&& visit) const;

  std::vector<glm::dvec3> positions_mm_;
  std::vector<glm::uvec3> triangles_;
  std::vector<std::uint32_t> order_;  ///< triangles, leaf by leaf
  std::vector<Node> nodes_;           ///< the root first; empty without triangles
  double reach_mm_ = 0.0;             ///< largest coordinate
};

}  // namespace nacre
