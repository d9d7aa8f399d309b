#include "shells/collapse_guard.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "shells/triangle_distance.h"

namespace nacre {
namespace {

constexpr double kLeastTurn = 0.25;     // cosine between a triangle's normals before and after
constexpr double kLeastQuality = 0.04;  // height over longest side
constexpr int kMaxSubdivisions = 64;

/// Height over longest side of a triangle: 0.87 for an equilateral one.
double quality(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
               const glm::dvec3& twice_area) {
  const auto squared = [](const glm::dvec3& v) { return glm::dot(v, v); };
  const double longest = std::max({squared(b - a), squared(c - b), squared(a - c)});
  return longest > 0.0 ? glm::length(twice_area) / longest : 0.0;
}

/// Calls `visit(point)` with the points of a triangle a spacing apart, the corners and side bc left
/// out; until it returns false. True if it never did.
template <class Visit>
bool visit_samples(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double spacing,
                   Visit&& visit) {
  const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  // Two at least: the middles of the sides.
  const double wanted = std::min(std::ceil(longest / spacing), double{kMaxSubdivisions});
  const int n = wanted > 2.0 ? static_cast<int>(wanted) : 2;
  if (n % 3 != 0 && !visit((a + b + c) / 3.0)) return false;
  for (int i = 1; i <= n; ++i) {  // the weight of a; 0 is side bc
    for (int j = 0; i + j <= n; ++j) {
      if (i == n) continue;
      const glm::dvec3 p = (static_cast<double>(i) * a + static_cast<double>(j) * b +
                            static_cast<double>(n - i - j) * c) /
                           static_cast<double>(n);
      if (!visit(p)) return false;
    }
  }
  return true;
}

}  // namespace

CollapseGuard::CollapseGuard(const SimplifyOptions& options, std::size_t face_count)
    : options_(options) {
  if (options_.error) face_error_.resize(face_count, 0.0f);
  if (options_.tolerance_mm > 0.0) face_distance_.resize(face_count, 0.0f);
}

double CollapseGuard::error_over(const glm::dvec3& a, const glm::dvec3& b,
                                 const glm::dvec3& c) const {
  double worst = 0.0;
  const auto visit = [&](const glm::dvec3& p) {
    worst = std::max(worst, options_.error(p));
    return true;
  };
  visit_samples(a, b, c, options_.sample_spacing_mm, visit);
  // The side that the samples leave out, and the corners.
  const int n = std::clamp(static_cast<int>(glm::distance(b, c) / options_.sample_spacing_mm) + 1,
                           2, kMaxSubdivisions);
  for (int i = 0; i <= n; ++i) visit(b + (c - b) * (static_cast<double>(i) / n));
  visit(a);
  return worst;
}

void CollapseGuard::add_face(std::uint32_t face, const glm::dvec3& a, const glm::dvec3& b,
                             const glm::dvec3& c) {
  if (options_.error) face_error_[face] = static_cast<float>(error_over(a, b, c));
}

bool CollapseGuard::allows(const FanMove& move) const {
  return keeps_shape(move) && keeps_error(move) && keeps_distance(move);
}

bool CollapseGuard::keeps_shape(const FanMove& move) const {
  return std::all_of(move.kept.begin(), move.kept.end(), [&](const FanTriangle& t) {
    const glm::dvec3 before = glm::cross(t.a - move.before, t.b - move.before);
    const glm::dvec3 after = glm::cross(t.a - move.after, t.b - move.after);
    const double aligned = glm::dot(before, after);
    if (aligned < kLeastTurn * glm::length(before) * glm::length(after)) return false;
    const double now = quality(move.after, t.a, t.b, after);
    return now >= kLeastQuality || now > quality(move.before, t.a, t.b, before);
  });
}

/// Every triangle that changes is held to the bound, or to its own error before.
bool CollapseGuard::keeps_error(const FanMove& move) const {
  if (!options_.error) return true;
  return std::all_of(move.kept.begin(), move.kept.end(), [&](const FanTriangle& t) {
    const double allowed = std::max(options_.error_tolerance, double{face_error_[t.face]});
    return visit_samples(move.after, t.a, t.b, options_.sample_spacing_mm,
                         [&](const glm::dvec3& p) { return options_.error(p) <= allowed; });
  });
}

/// Distance between the fan before and after, sampled both ways: at the vertex that goes, the
/// middles of the edges that move, and the centres of the triangles they move to. More than
/// `enough` is not told apart.
double CollapseGuard::distance_moved(const FanMove& move, double enough) const {
  double farthest = 0.0;
  const auto visit = [&](const glm::dvec3& p, const glm::dvec3& apex, bool is_after) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const FanTriangle& t : move.kept) {
      nearest = std::min(nearest, squared_distance_to_triangle(p, apex, t.a, t.b));
    }
    if (!is_after) {
      for (const FanTriangle& t : move.removed) {
        nearest = std::min(nearest, squared_distance_to_triangle(p, apex, t.a, t.b));
      }
    }
    farthest = std::max(farthest, std::sqrt(nearest));
    return farthest <= enough;
  };
  if (!visit(move.before, move.after, true)) return farthest;
  for (const FanTriangle& t : move.kept) {
    if (!visit(0.5 * (move.before + t.a), move.after, true) ||
        !visit(0.5 * (move.after + t.a), move.before, false) ||
        !visit((move.after + t.a + t.b) / 3.0, move.before, false)) {
      return farthest;
    }
  }
  return farthest;
}

/// What has been spent of the distance on the fan's triangles.
double CollapseGuard::distance_spent(const FanMove& move) const {
  float spent = 0.0f;
  for (const FanTriangle& t : move.kept) spent = std::max(spent, face_distance_[t.face]);
  for (const FanTriangle& t : move.removed) spent = std::max(spent, face_distance_[t.face]);
  return spent;
}

bool CollapseGuard::keeps_distance(const FanMove& move) const {
  if (options_.tolerance_mm <= 0.0) return true;
  const double left = options_.tolerance_mm - distance_spent(move);
  return left > 0.0 && distance_moved(move, left) <= left;
}

void CollapseGuard::commit(const FanMove& move) {
  if (options_.tolerance_mm > 0.0) {
    const double whole = std::numeric_limits<double>::infinity();
    const auto distance = static_cast<float>(distance_spent(move) + distance_moved(move, whole));
    for (const FanTriangle& t : move.kept) face_distance_[t.face] = distance;
  }
  if (options_.error) {
    for (const FanTriangle& t : move.kept) {
      face_error_[t.face] = static_cast<float>(error_over(move.after, t.a, t.b));
    }
  }
}

}  // namespace nacre
