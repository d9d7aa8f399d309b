#include "shells/distance_budget.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shells/triangle_distance.h"

namespace nacre {
namespace {

double squared_distance_to_old(const Star& star, const glm::dvec3& q) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < star.ring.size(); ++i) {
    nearest = std::min(nearest, squared_distance_to_triangle(q, star.triangles[i].apex_before,
                                                             star.ring[i], star.after(i)));
  }
  for (const Star::Removed& t : star.removed) {
    nearest = std::min(nearest, squared_distance_to_triangle(q, t.a, t.b, t.c));
  }
  return nearest;
}

double squared_distance_to_new(const Star& star, const glm::dvec3& p, const glm::dvec3& q) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < star.ring.size(); ++i) {
    nearest = std::min(nearest, squared_distance_to_triangle(q, p, star.ring[i], star.after(i)));
  }
  return nearest;
}

/// Distance between the star's triangles before and after, sampled both ways: at the vertices that
/// go and the one that comes, the middles of the edges that move, and the centres of the triangles
/// they move to. More than `enough` is not told apart.
double distance_moved(const Star& star, const glm::dvec3& p, double enough) {
  double farthest = 0.0;
  const auto is_enough = [&](double squared) {
    farthest = std::max(farthest, std::sqrt(squared));
    return farthest > enough;
  };
  if (is_enough(squared_distance_to_old(star, p))) return farthest;
  for (std::size_t i = 0; i < star.ring.size(); ++i) {
    const glm::dvec3& a = star.ring[i];
    const glm::dvec3& was = star.triangles[i].apex_before;
    if (is_enough(squared_distance_to_new(star, p, was)) ||
        is_enough(squared_distance_to_new(star, p, 0.5 * (was + a))) ||
        is_enough(squared_distance_to_old(star, 0.5 * (p + a))) ||
        is_enough(squared_distance_to_old(star, (p + a + star.after(i)) / 3.0))) {
      return farthest;
    }
  }
  return farthest;
}

}  // namespace

double DistanceBudget::spent(const Star& star) const {
  float most = 0.0f;
  for (const StarTriangle& t : star.triangles) most = std::max(most, spent_[t.face]);
  for (const Star::Removed& t : star.removed) most = std::max(most, spent_[t.face]);
  return most;
}

bool DistanceBudget::allows(const Star& star, const glm::dvec3& p) const {
  if (spent_.empty()) return true;
  const double left = tolerance_ - spent(star);
  return left > 0.0 && distance_moved(star, p, left) <= left;
}

void DistanceBudget::commit(const Star& star, const glm::dvec3& p) {
  if (spent_.empty()) return;
  const double moved = distance_moved(star, p, std::numeric_limits<double>::infinity());
  const auto distance = static_cast<float>(spent(star) + moved);
  for (const StarTriangle& t : star.triangles) spent_[t.face] = distance;
}

}  // namespace nacre
