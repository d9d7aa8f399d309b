#include "shells/hausdorff.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <atomic>
#include <glm/geometric.hpp>
#include <limits>

#include "shells/triangle_tree.h"

namespace nacre {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

void raise(std::atomic<double>& most, double value) {
  double known = most.load();
  while (value > known && !most.compare_exchange_weak(known, value)) {
  }
}

/// The largest distance of some points: corners, middles of sides, and inner points. Those that are
/// nearer than the largest so far are not measured exactly; the largest is the same in any order.
double farthest_sample(const TriangleMesh& from, const TriangleTree& to) {
  std::atomic<double> most{0.0};
  const auto take = [&](const glm::dvec3& p) {
    // Any triangle within the largest so far settles it.
    if (to.cover_radius({p, p, p}, kFar, most.load()) > most.load()) {
      raise(most, to.distance(p, kFar));
    }
  };
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, from.triangles.size(), 1024), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const glm::uvec3& t = from.triangles[i];
          const glm::dvec3 center =
              glm::dvec3(from.positions[t.x] + from.positions[t.y] + from.positions[t.z]) / 3.0;
          take(center);
          for (int corner = 0; corner < 3; ++corner) {
            const glm::dvec3 p(from.positions[t[corner]]);
            take(p);
            take(0.5 * (p + glm::dvec3(from.positions[t[(corner + 1) % 3]])));
            take(0.5 * (p + center));
          }
        }
      });
  return most.load();
}

/// Finds the bounds of one triangle, given that some point is `known` away.
class PieceBounds {
 public:
  PieceBounds(const TriangleTree& to, double known, double error)
      : to_(to), lower_(known), upper_(known), error_(error) {}

  void add(const TriangleCorners& piece) {
    const double enough = lower_ + error_;
    const double cover = to_.cover_radius(piece, kFar, enough);
    // All points are within the distance of one, and as much more as they are away from it.
    const glm::dvec3 center = (piece[0] + piece[1] + piece[2]) / 3.0;
    double radius = 0.0;
    for (const glm::dvec3& corner : piece) radius = std::max(radius, glm::distance(corner, center));
    const double at_center = cover > enough ? to_.distance(center, kFar) : 0.0;
    lower_ = std::max(lower_, at_center);
    const double bound = cover > enough ? std::min(cover, at_center + radius) : cover;
    if (bound <= lower_ + error_) {
      upper_ = std::max(upper_, bound);
      return;
    }
    cut(piece);
  }

  BoundedDistance result() const { return {lower_, std::max(lower_, upper_)}; }

 private:
  /// Into four by the middles of the sides.
  void cut(const TriangleCorners& piece) {
    const auto& [a, b, c] = piece;
    const glm::dvec3 ab = 0.5 * (a + b);
    const glm::dvec3 bc = 0.5 * (b + c);
    const glm::dvec3 ca = 0.5 * (c + a);
    add({a, ab, ca});
    add({ab, b, bc});
    add({ca, bc, c});
    add({ab, bc, ca});
  }

  const TriangleTree& to_;
  double lower_;
  double upper_;
  double error_;
};

BoundedDistance larger(const BoundedDistance& a, const BoundedDistance& b) {
  return {std::max(a.lower_mm, b.lower_mm), std::max(a.upper_mm, b.upper_mm)};
}

}  // namespace

BoundedDistance hausdorff_distance(const TriangleMesh& from, const TriangleMesh& to,
                                   double error_mm) {
  if (from.triangles.empty()) return {};
  if (to.triangles.empty()) return {kFar, kFar};
  const TriangleTree tree(to);
  const double known = farthest_sample(from, tree);
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, from.triangles.size(), 1024),
      BoundedDistance{known, known},
      [&](const auto& range, BoundedDistance bounds) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const glm::uvec3& t = from.triangles[i];
          // Each triangle starts from the samples' distance alone, so that its bounds do not
          // depend on what other threads have found.
          PieceBounds piece(tree, known, error_mm);
          piece.add({glm::dvec3(from.positions[t.x]), glm::dvec3(from.positions[t.y]),
                     glm::dvec3(from.positions[t.z])});
          bounds = larger(bounds, piece.result());
        }
        return bounds;
      },
      larger);
}

}  // namespace nacre
