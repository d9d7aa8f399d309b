#include "datasets/closed_forms.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace nacre {
namespace {

constexpr double kPiSquared = std::numbers::pi * std::numbers::pi;

/// Distance of a line from the origin.
double distance_from_origin(const Ray& line) {
  return glm::length(glm::cross(line.origin_mm, line.direction));
}

/// Half the chord of a line in a sphere about the origin; 0 where it misses.
double half_chord(double radius, double distance) {
  return std::sqrt(std::max(0.0, (radius - distance) * (radius + distance)));
}

}  // namespace

double SphereField::value(const glm::dvec3& p_mm) const {
  return std::max(0.0, radius_mm - glm::length(p_mm));
}

double SphereField::level_radius_mm(double level) const { return radius_mm - level; }

double SphereField::maximum(const Ray& line) const {
  return std::max(0.0, radius_mm - distance_from_origin(line));
}

double SphereField::integral(const Ray& line) const {
  const double d = distance_from_origin(line);
  const double h = half_chord(radius_mm, d);
  // d^2 asinh(h / d) vanishes with d; below this distance the quotient would overflow.
  const double bend = d > 1e-150 ? d * d * std::asinh(h / d) : 0.0;
  return radius_mm * h - bend;
}

double SphereField::chord_mm(const Ray& line, double level) const {
  return 2.0 * half_chord(level_radius_mm(level), distance_from_origin(line));
}

double TorusField::value(const glm::dvec3& p_mm) const {
  const double from_ring = std::sqrt(p_mm.x * p_mm.x + p_mm.y * p_mm.y) - major_radius_mm;
  return minor_radius_mm - std::sqrt(from_ring * from_ring + p_mm.z * p_mm.z);
}

double TorusField::level_area_mm2(double level) const {
  return 4.0 * kPiSquared * major_radius_mm * (minor_radius_mm - level);
}

double TorusField::level_volume_mm3(double level) const {
  const double tube = minor_radius_mm - level;
  return 2.0 * kPiSquared * major_radius_mm * tube * tube;
}

double TorusField::maximum_along_z(double x_mm, double y_mm) const {
  return value({x_mm, y_mm, 0.0});
}

double TorusField::maximum_along_x(double y_mm, double z_mm) const {
  const double beside = std::max(0.0, std::abs(y_mm) - major_radius_mm);
  return minor_radius_mm - std::sqrt(beside * beside + z_mm * z_mm);
}

double QuadraticField::value(const glm::dvec3& p_mm) const {
  return offset + glm::dot(curvature, p_mm * p_mm);
}

glm::dvec3 QuadraticField::level_semi_axes_mm(double level) const {
  return glm::sqrt((level - offset) / curvature);
}

double QuadraticField::maximum(const Ray& line) const {
  const double slope = 2.0 * glm::dot(curvature, line.origin_mm * line.direction);
  const double bend = glm::dot(curvature, line.direction * line.direction);
  return value(line.origin_mm) - slope * slope / (4.0 * bend);
}

double QuadraticField::integral(const Ray& line, double t_enter_mm, double t_leave_mm) const {
  const double slope = 2.0 * glm::dot(curvature, line.origin_mm * line.direction);
  const double bend = glm::dot(curvature, line.direction * line.direction);
  const auto antiderivative = [&](double t) {
    return t * (value(line.origin_mm) + t * (slope / 2.0 + t * bend / 3.0));
  };
  return antiderivative(t_leave_mm) - antiderivative(t_enter_mm);
}

double QuadraticField::trilinear_value(const glm::dvec3& p_mm, const glm::dvec3& spacing_mm,
                                       const glm::dvec3& fraction) const {
  return value(p_mm) + glm::dot(curvature, spacing_mm * spacing_mm * fraction * (1.0 - fraction));
}

double CellField::value(const glm::dvec3& p) const {
  double sum = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const double x = (corner & 1) != 0 ? p.x : 1.0 - p.x;
    const double y = (corner & 2) != 0 ? p.y : 1.0 - p.y;
    const double z = (corner & 4) != 0 ? p.z : 1.0 - p.z;
    sum += corners[corner] * x * y * z;
  }
  return sum;
}

std::array<double, 4> CellField::cubic_along(const glm::dvec3& origin,
                                             const glm::dvec3& direction) const {
  std::array<double, 4> cubic{};
  for (unsigned corner = 0; corner < 8; ++corner) {
    // The corner's weight is a product of three linear factors a + b t.
    std::array<double, 4> term{corners[corner], 0.0, 0.0, 0.0};
    for (int axis = 0; axis < 3; ++axis) {
      const bool far = (corner >> axis & 1) != 0;
      const double a = far ? origin[axis] : 1.0 - origin[axis];
      const double b = far ? direction[axis] : -direction[axis];
      for (std::size_t power = 3; power > 0; --power) {
        term[power] = a * term[power] + b * term[power - 1];
      }
      term[0] *= a;
    }
    for (std::size_t power = 0; power < 4; ++power) cubic[power] += term[power];
  }
  return cubic;
}

double CheckerboardField::value(const glm::dvec3& p_voxel) const {
  const auto triangle_wave = [](double x) {
    const double base = std::floor(x);
    const double sign = std::fmod(base, 2.0) == 0.0 ? 1.0 : -1.0;
    return sign * (1.0 - 2.0 * (x - base));
  };
  return 0.5 - 0.5 * triangle_wave(p_voxel.x) * triangle_wave(p_voxel.y) * triangle_wave(p_voxel.z);
}

}  // namespace nacre
