#include "shells/level_field.h"

#include <algorithm>
#include <span>

namespace nacre {
namespace {

double slope(const EmissionKnot& a, const EmissionKnot& b) noexcept {
  return (b.emission - a.emission) / (b.value - a.value);
}

}  // namespace

LevelField::LevelField(const TrilinearField& field, const EmissionMap& emission, double level)
    : field_(field), emission_(emission), level_(level), value_(emission.value_at(level)) {
  const std::span<const EmissionKnot> knots = emission_.knots();
  slope_below_ = slope(knots[0], knots[1]);
  slope_above_ = slope(knots[knots.size() - 2], knots[knots.size() - 1]);
  // The piece that rises to the level: its last knot is the first that reaches it.
  std::size_t last = 1;
  while (last + 1 < knots.size() && knots[last].emission < level) ++last;
  lo_ = knots[last - 1].value;
  hi_ = knots[last].value;
  slope_ = slope(knots[last - 1], knots[last]);
}

FieldSample LevelField::operator()(const glm::dvec3& p_mm) const noexcept {
  const glm::dvec3 p = field_.voxel_from_local(p_mm);
  const ValueAndGradient at = field_.sample(p);
  double error = 0.0;
  double slope_here = slope_;
  if (at.value >= lo_ && at.value <= hi_) {
    error = slope_ * (at.value - value_);
  } else {
    const double below = std::min(at.value - emission_.lo(), 0.0);
    const double above = std::max(at.value - emission_.hi(), 0.0);
    error = emission_(at.value) - level_ + slope_below_ * below + slope_above_ * above;
    if (below < 0.0) slope_here = slope_below_;
    if (above > 0.0) slope_here = slope_above_;
  }
  if (!field_.is_within(p)) {
    if (field_.is_outside(p)) return {1.0, glm::dvec3(0.0)};
    if (error > 0.0) return {0.0, glm::dvec3(0.0)};
  }
  return {error, slope_here * field_.gradient_per_mm(p, at.gradient)};
}

}  // namespace nacre
