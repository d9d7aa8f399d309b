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

/// Bound of the distance to the input after the move: what was spent on the fan before, and how far
/// the fan moves.
double CollapseGuard::distance_after(const FanMove& move) const {
  double spent = 0.0;
  for (const FanTriangle& t : move.kept) spent = std::max(spent, double{face_distance_[t.face]});
  for (const FanTriangle& t : move.removed) spent = std::max(spent, double{face_distance_[t.face]});
  double moved = 0.0;
  const auto add = [&](const FanTriangle& from, const glm::dvec3& apex, const glm::dvec3& to) {
    const auto visit = [&](const glm::dvec3& p) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const FanTriangle& t : move.kept) {
        nearest = std::min(nearest, squared_distance_to_triangle(p, to, t.a, t.b));
      }
      if (to == move.before) {
        for (const FanTriangle& t : move.removed) {
          nearest = std::min(nearest, squared_distance_to_triangle(p, to, t.a, t.b));
        }
      }
      moved = std::max(moved, nearest);
      return true;
    };
    visit(apex);
    // Samples of the fan, not of the field: the middles and the centre will do.
    visit_samples(apex, from.a, from.b, std::numeric_limits<double>::infinity(), visit);
  };
  for (const FanTriangle& t : move.kept) {
    add(t, move.before, move.after);
    add(t, move.after, move.before);
  }
  for (const FanTriangle& t : move.removed) add(t, move.before, move.after);
  return spent + std::sqrt(moved);
}

bool CollapseGuard::keeps_distance(const FanMove& move) const {
  return options_.tolerance_mm <= 0.0 || distance_after(move) <= options_.tolerance_mm;
}

void CollapseGuard::commit(const FanMove& move) {
  if (options_.tolerance_mm > 0.0) {
    const auto distance = static_cast<float>(distance_after(move));
    for (const FanTriangle& t : move.kept) face_distance_[t.face] = distance;
  }
  if (options_.error) {
    for (const FanTriangle& t : move.kept) {
      face_error_[t.face] = static_cast<float>(error_over(move.after, t.a, t.b));
    }
  }
}

}  // namespace nacre
