#include "shells/star_fit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shells/symmetric_solve.h"

namespace nacre {
namespace {

constexpr int kFewestParts = 2;  // a side's middle at least
constexpr int kMostParts = 64;
constexpr double kOutOfProportion = 2.0;
constexpr double kDamping = 1e-3;  // of the normal equations, as a part of their mean eigenvalue

double squared(const glm::dvec3& v) { return glm::dot(v, v); }

/// Parts of at most a sample's distance that a length is cut into.
int parts_of(double squared_samples) {
  if (!(squared_samples > double{kFewestParts * kFewestParts})) return kFewestParts;
  return static_cast<int>(std::min(std::ceil(std::sqrt(squared_samples)), double{kMostParts}));
}

/// Calls `visit(point, weight of p)` with the points strictly between the ends of a spoke, as far
/// apart as samples are, until it says false.
template <class Visit>
bool visit_spoke(const glm::dvec3& p, const glm::dvec3& end, const glm::dmat3& samples_from_mm,
                 Visit&& visit) {
  const int n = parts_of(squared(samples_from_mm * (end - p)));
  for (int i = 1; i < n; ++i) {
    const double w = static_cast<double>(i) / n;
    if (!visit(w * p + (1.0 - w) * end, w)) return false;
  }
  return true;
}

/// Calls `visit(point, weight of p)` with the points strictly within a triangle, as far apart as
/// samples are; its centre at least.
template <class Visit>
bool visit_inside(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                  const glm::dmat3& samples_from_mm, Visit&& visit) {
  const glm::dvec3 to_a = samples_from_mm * (a - p);
  const glm::dvec3 to_b = samples_from_mm * (b - p);
  const int n = parts_of(std::max({squared(to_a), squared(to_b), squared(to_b - to_a)}));
  if (n == kFewestParts) return visit((p + a + b) / 3.0, 1.0 / 3.0);
  const double part = 1.0 / n;
  for (int i = 1; i < n - 1; ++i) {
    for (int j = 1; i + j < n; ++j) {
      const double w = i * part;
      if (!visit(w * p + (j * part) * a + ((n - i - j) * part) * b, w)) return false;
    }
  }
  return true;
}

}  // namespace

bool StarFit::add(const glm::dvec3& p, double weight, double allowed, double& worst) {
  const FieldSample at = field_(p);
  const double size = std::abs(at.error);
  if (at.gradient == glm::dvec3(0.0)) is_pinned_ = true;
  worst = std::max(worst, size);
  if (!(size <= allowed)) {
    is_within_ = false;
    if (!(size <= kOutOfProportion * allowed)) return false;
  }
  accumulate(at.error, weight * at.gradient, 1.0);
  squared_weights_ += weight * weight;
  ++count_;
  return true;
}

bool StarFit::sample_spoke(const glm::dvec3& p, const glm::dvec3& end, double allowed,
                           double& worst) {
  return visit_spoke(p, end, samples_from_mm_, [&](const glm::dvec3& q, double weight) {
    return add(q, weight, allowed, worst);
  });
}

bool StarFit::sample_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                              double allowed, double& worst) {
  return visit_inside(p, a, b, samples_from_mm_, [&](const glm::dvec3& q, double weight) {
    return add(q, weight, allowed, worst);
  });
}

/// Adds the volume between the star and what it was as one more error: the surface's mean rise, as
/// the field's mean slope turns it into an error.
void StarFit::add_volume(const Star& star, const glm::dvec3& p) {
  glm::dvec3 normal(0.0);  // six times the volume's gradient
  double twice_area = 0.0;
  double volume = 0.0;  // six times
  for (std::size_t i = 0; i < star.ring.size(); ++i) {
    const glm::dvec3 n = glm::cross(star.ring[i] - p, star.after(i) - p);
    normal += n;
    twice_area += glm::length(n);
    volume -= glm::dot(n, star.triangles[i].apex_before - p);
  }
  for (const Star::Removed& t : star.removed) {
    volume -= glm::dot(glm::cross(t.a - p, t.b - p), t.c - p);
  }
  const double squared_slope = (diagonal_.x + diagonal_.y + diagonal_.z) / squared_weights_;
  if (!(twice_area > 0.0) || !(squared_slope > 0.0)) return;
  const double slope = std::sqrt(squared_slope);
  accumulate(slope * volume / twice_area, slope / twice_area * normal,
             volume_weight_ * static_cast<double>(count_));
}

void StarFit::accumulate(double error, const glm::dvec3& g, double weight) {
  squares_ += weight * error * error;
  diagonal_ += weight * g * g;
  beside_ += weight * glm::dvec3(g.x * g.y, g.x * g.z, g.y * g.z);
  right_ -= weight * error * g;
}

bool StarFit::sample(const Star& star, const glm::dvec3& p, std::span<const double> allowed) {
  is_within_ = true;
  is_pinned_ = false;
  squares_ = 0.0;
  count_ = 0;
  squared_weights_ = 0.0;
  diagonal_ = beside_ = right_ = glm::dvec3(0.0);
  const std::size_t n = star.ring.size();
  triangle_errors_.assign(n, 0.0);
  if (!field_) return true;
  // A point that triangles share has to satisfy each: the least of what they allow.
  double apex_error = 0.0;
  if (!add(p, 1.0, *std::min_element(allowed.begin(), allowed.end()), apex_error)) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t previous = i == 0 ? n - 1 : i - 1;
    double spoke_error = 0.0;
    if (!sample_spoke(p, star.ring[i], std::min(allowed[i], allowed[previous]), spoke_error) ||
        !sample_triangle(p, star.ring[i], star.after(i), allowed[i], triangle_errors_[i])) {
      return false;
    }
    triangle_errors_[i] = std::max({triangle_errors_[i], spoke_error, apex_error});
    triangle_errors_[previous] = std::max(triangle_errors_[previous], spoke_error);
  }
  add_volume(star, p);
  return true;
}

double StarFit::change(const glm::dvec3& d) const noexcept {
  const glm::dvec3 crossed(d.x * d.y, d.x * d.z, d.y * d.z);
  return glm::dot(diagonal_, d * d) + 2.0 * (glm::dot(beside_, crossed) - glm::dot(right_, d));
}

glm::dvec3 StarFit::step() const {
  const double mean = (diagonal_.x + diagonal_.y + diagonal_.z) / 3.0;
  if (!(mean > 0.0)) return glm::dvec3(0.0);
  return solve_symmetric(diagonal_ + kDamping * mean, beside_, right_);
}

bool stays_within(const Star& star, const glm::dvec3& p, const SurfaceField& field,
                  const glm::dmat3& samples_from_mm, double allowed) {
  const auto is_within = [&](const glm::dvec3& q, double) {
    return std::abs(field(q).error) <= allowed;
  };
  if (!is_within(p, 1.0)) return false;
  for (std::size_t i = 0; i < star.ring.size(); ++i) {
    const glm::dvec3& a = star.ring[i];
    if (!visit_spoke(p, a, samples_from_mm, is_within) ||
        !visit_inside(p, a, star.after(i), samples_from_mm, is_within)) {
      return false;
    }
  }
  return true;
}

double inner_error(const SurfaceField& field, const glm::dmat3& samples_from_mm,
                   const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  double worst = 0.0;
  visit_inside(a, b, c, samples_from_mm, [&](const glm::dvec3& p, double) {
    worst = std::max(worst, std::abs(field(p).error));
    return true;
  });
  return worst;
}

double side_error(const SurfaceField& field, const glm::dmat3& samples_from_mm, const glm::dvec3& a,
                  const glm::dvec3& b) {
  double worst = 0.0;
  const int n = parts_of(squared(samples_from_mm * (b - a)));
  for (int i = 1; i < n; ++i) {
    worst = std::max(worst, std::abs(field(a + (b - a) * (static_cast<double>(i) / n)).error));
  }
  return worst;
}

}  // namespace nacre
