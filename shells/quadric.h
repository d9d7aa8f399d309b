#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "shells/symmetric_solve.h"

namespace nacre {

/// A sum of weighted squared distances to planes, as a function of a point: x^T A x + 2 b.x + c
/// (Garland, Heckbert 1997, "Surface Simplification Using Quadric Error Metrics").
struct Quadric {
  glm::dvec3 diagonal{0.0};  ///< of A: xx, yy, zz
  glm::dvec3 beside{0.0};    ///< xy, xz, yz
  glm::dvec3 b{0.0};
  double c = 0.0;
  double weight = 0.0;  ///< of all planes

  /// Adds w * (g.x + d)^2.
  void add(const glm::dvec3& g, double d, double w) noexcept {
    diagonal += w * g * g;
    beside += w * glm::dvec3(g.x * g.y, g.x * g.z, g.y * g.z);
    b += w * d * g;
    c += w * d * d;
    weight += w;
  }

  Quadric& operator+=(const Quadric& other) noexcept {
    diagonal += other.diagonal;
    beside += other.beside;
    b += other.b;
    c += other.c;
    weight += other.weight;
    return *this;
  }

  /// Half the gradient: A x + b.
  glm::dvec3 slope(const glm::dvec3& x) const noexcept {
    return diagonal * x +
           glm::dvec3(beside.x * x.y + beside.y * x.z, beside.x * x.x + beside.z * x.z,
                      beside.y * x.x + beside.z * x.y) +
           b;
  }

  double operator()(const glm::dvec3& x) const noexcept {
    return glm::dot(x, slope(x)) + glm::dot(b, x) + c;
  }

  /// How far from x the least value is; directions along which nothing changes are left alone.
  glm::dvec3 step_to_least(const glm::dvec3& x, double damping) const noexcept {
    const double mean = (diagonal.x + diagonal.y + diagonal.z) / 3.0;
    if (!(mean > 0.0)) return glm::dvec3(0.0);
    return solve_symmetric(diagonal + damping * mean, beside, -slope(x));
  }
};

}  // namespace nacre
