#include "datasets/head_tissue.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "datasets/random.h"

namespace nacre {
namespace {

constexpr std::uint64_t kFoldingSalt = 0x666f6c64;

constexpr double kFluid = 110.0;
constexpr double kBone = 45.0;
constexpr double kFat = 290.0;
constexpr double kWhite = 235.0;
constexpr double kGray = 268.0;

/// From a below the edge to b above it, a smooth step of that width.
double step(double a, double b, double edge, double width, double x) {
  const double u = std::clamp((x - edge) / width + 0.5, 0.0, 1.0);
  return a + (b - a) * u * u * (3.0 - 2.0 * u);
}

/// 1 in the middle of an ellipsoid, 0 from its surface on.
double inside_ellipsoid(const glm::dvec3& p, const glm::dvec3& center, const glm::dvec3& axes) {
  const glm::dvec3 q = (p - center) / axes;
  return step(1.0, 0.0, 0.9, 0.2, std::sqrt(glm::dot(q, q)));
}

/// The cortex's folding: a smooth random field, its zero surfaces the sulci. Two octaves, turned
/// against the grid and each other, or the lattice would show.
double folding_at(const glm::dvec3& p, std::uint64_t seed) {
  const glm::dvec3 coarse(2.0 * p.x - p.y + 2.0 * p.z, 2.0 * p.x + 2.0 * p.y - p.z,
                          -p.x + 2.0 * p.y + 2.0 * p.z);
  const glm::dvec3 fine(6.0 * p.x + 3.0 * p.y + 2.0 * p.z, -2.0 * p.x + 6.0 * p.y - 3.0 * p.z,
                        -3.0 * p.x + 2.0 * p.y + 6.0 * p.z);
  // The rows have lengths 3 and 7: lattices of 9 and 4.5 mm.
  return smooth_noise(seed, coarse / 27.0) + 0.4 * smooth_noise(~seed, fine / 31.5);
}

}  // namespace

HeadTissue::HeadTissue(std::uint64_t seed) : folding_seed_(random_bits(seed, kFoldingSalt)) {}

double HeadTissue::brain_signal(const glm::dvec3& p_mm, double scale, double folding) const {
  // Sulci: clefts of fluid along the folding's zero surfaces, deeper inwards narrower.
  const double depth = std::clamp((scale - 0.76) / 0.2, 0.0, 1.0);
  const double cleft = 1.0 - std::clamp(std::abs(folding) / (0.03 + 0.09 * depth), 0.0, 1.0);
  const double midline = 1.0 - std::clamp(std::abs(p_mm.x) / 1.6, 0.0, 1.0);
  const double cortex = step(kWhite, kGray, 0.88, 0.04, scale + 0.15 * std::abs(folding) * depth);
  const double fissure = p_mm.z > 5.0 ? midline : 0.0;
  const double fluid = std::max(depth * cleft, fissure);
  // Lateral ventricles, the left one folded onto the right.
  const glm::dvec3 folded{std::abs(p_mm.x), p_mm.y, p_mm.z};
  const double ventricle = inside_ellipsoid(folded, {9.0, 4.0, 10.0}, {6.5, 30.0, 8.0});
  return cortex + (kFluid - cortex) * std::max(0.8 * fluid, ventricle);
}

double HeadTissue::signal(const glm::dvec3& p_mm) const {
  constexpr double wall = 0.015;  // width of the steps, in brain scales: about a millimetre
  const double scale = brain_.scale_of(p_mm);
  if (scale > 1.25) return 0.0;
  const double folding = folding_at(p_mm, folding_seed_);
  const double ripple = scale + 0.01 * folding;
  if (ripple > 1.13) {
    const double outside = step(kFat, 0.0, 1.19, wall, scale);
    return step(kBone, outside, 1.14, wall, ripple);
  }
  if (ripple > 1.02) return step(kFluid, kBone, 1.05, wall, ripple);
  return step(brain_signal(p_mm, scale, folding), kFluid, 1.0, wall, ripple);
}

double coil_gain(const glm::dvec3& p_mm) {
  const double around = (p_mm.x * p_mm.x + p_mm.y * p_mm.y) / (90.0 * 90.0);
  const double along = p_mm.z / 50.0;
  return 1.0 + 0.16 * around - 0.12 * along * along;
}

}  // namespace nacre
