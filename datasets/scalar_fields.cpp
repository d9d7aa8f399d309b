#include "datasets/scalar_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "datasets/portable_math.h"

namespace nacre {
namespace {

enum class Shape { S, P, D };

/// One orbital, and by symmetry its images under x to -x and y to -y.
struct Orbital {
  Shape shape;
  glm::dvec3 atom_mm;
  glm::dvec3 axis;  ///< of unit length
  double rho_mm;
  double coefficient;
};

constexpr double kSlant = 0.70710678118654752;

constexpr std::array<Orbital, 9> kOrbitals{{
    // Two irons on the x axis, their d orbitals along and across the bridge.
    {Shape::D, {12, 0, 2}, {1, 0, 0}, 2.4, 240.0},
    {Shape::D, {12, 0, 2}, {0, 0, 1}, 2.2, -130.0},
    // Bridging sulfurs on the y axis.
    {Shape::P, {0, 13, 4}, {0, 1, 0}, 3.7, 760.0},
    {Shape::S, {0, 13, 4}, {0, 0, 1}, 3.2, -380.0},
    // Terminal sulfurs beyond the irons, above and below.
    {Shape::P, {21, 0, 18}, {kSlant, 0, kSlant}, 3.5, -720.0},
    {Shape::P, {21, 9, -15}, {kSlant, 0, -kSlant}, 3.7, 860.0},
    // The carbons behind them.
    {Shape::S, {8, 21, -21}, {0, 0, 1}, 3.2, 640.0},
    {Shape::P, {7, 7, 24}, {0, 0, 1}, 3.2, 700.0},
    {Shape::D, {0, 0, -12}, {0, 0, 1}, 2.9, 190.0},
}};

double orbital_value(const Orbital& orbital, const glm::dvec3& p_mm) {
  const glm::dvec3 u = (p_mm - orbital.atom_mm) / orbital.rho_mm;
  const double squared = glm::dot(u, u);
  const double along = glm::dot(orbital.axis, u);
  const double decay = orbital.coefficient * portable_exp(-std::sqrt(squared));
  switch (orbital.shape) {
    case Shape::S: return decay;
    case Shape::P: return decay * along;
    case Shape::D: break;
  }
  return decay * (3.0 * along * along - squared);
}

/// A well: where it stands and its share of the contaminant.
struct Well {
  glm::dvec3 p_mm;
  double strength;
};

constexpr std::array<Well, 2> kWells{{{{-20.0, 10.0, -190.0}, 1.0}, {{28.0, -16.0, -140.0}, 0.5}}};

constexpr int kPuffs = 32;

/// A puff leaves the well with the spread it would have after this time: the well's own width.
constexpr double kInitialAgeS = 50.0;

/// Makes the largest concentration of the default plume about 100 mg/l.
constexpr double kMass = 2.5e6;

}  // namespace

double hipip_value(const glm::dvec3& p_mm) {
  // Even in x and y: folded first, so that rounding is, too.
  const glm::dvec3 folded{std::abs(p_mm.x), std::abs(p_mm.y), p_mm.z};
  double psi = 0.0;
  for (const Orbital& orbital : kOrbitals) {
    // An atom on a mirror plane is its own image.
    const int images_x = orbital.atom_mm.x == 0.0 ? 1 : 2;
    const int images_y = orbital.atom_mm.y == 0.0 ? 1 : 2;
    for (int image = 0; image < images_x * images_y; ++image) {
      const double x = image % images_x == 0 ? folded.x : -folded.x;
      const double y = image / images_x == 0 ? folded.y : -folded.y;
      psi += orbital_value(orbital, {x, y, folded.z});
    }
  }
  return std::clamp(psi, -255.0, 255.0);
}

double PlumeField::value(const glm::dvec3& p_mm) const {
  double sum = 0.0;
  for (const Well& well : kWells) {
    for (int puff = 0; puff < kPuffs; ++puff) {
      const double travel_s = last_release_age_s + release_s * puff / (kPuffs - 1);
      const double age_s = travel_s + kInitialAgeS;
      const double along = 2.0 * along_mm2_s * age_s;
      const double across = 2.0 * across_mm2_s * age_s;
      const glm::dvec3 u = p_mm - well.p_mm - glm::dvec3(0.0, 0.0, velocity_mm_s * travel_s);
      const double exponent = 0.5 * (u.z * u.z / along + (u.x * u.x + u.y * u.y) / across);
      sum += well.strength / (std::sqrt(along) * across) * portable_exp(-exponent);
    }
  }
  return kMass / kPuffs * sum;
}

}  // namespace nacre
