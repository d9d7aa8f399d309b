#include "reference/mean_emission.h"

#include <algorithm>
#include <span>
#include <vector>

namespace nacre {
namespace {

double mean(const BernsteinCubic& f) { return 0.25 * ((f.b[0] + f.b[3]) + (f.b[1] + f.b[2])); }

/// The mean of T(f) where f keeps to one linear piece of T, so that T(mean f) is it. Rounding may
/// put single values of f a hair beyond the piece's knots; its mean lies inside.
double mean_within_piece(const EmissionMap& map, const BernsteinCubic& f) { return map(mean(f)); }

/// Whether a knot lies strictly between the cubic's least and greatest coefficient: only such a
/// knot can be crossed.
bool any_between(std::span<const EmissionKnot> knots, double least, double greatest) {
  return std::any_of(knots.begin(), knots.end(), [=](const EmissionKnot& knot) {
    return knot.value > least && knot.value < greatest;
  });
}

}  // namespace

double mean_emission(const EmissionMap& map, const BernsteinCubic& f) {
  const auto [least, greatest] = std::minmax_element(f.b.begin(), f.b.end());
  if (!any_between(map.knots(), *least, *greatest)) return mean_within_piece(map, f);

  std::vector<double> splits{0.0, 1.0};
  for (const EmissionKnot& knot : map.knots()) {
    const UnitRoots roots = crossings(f, knot.value);
    splits.insert(splits.end(), roots.s.begin(), roots.s.begin() + roots.count);
  }
  std::sort(splits.begin(), splits.end());
  double sum = 0.0;
  for (std::size_t i = 1; i < splits.size(); ++i) {
    const double width = splits[i] - splits[i - 1];
    if (width > 0.0) {
      sum += width * mean_within_piece(map, restrict_to(f, splits[i - 1], splits[i]));
    }
  }
  return sum;
}

}  // namespace nacre
