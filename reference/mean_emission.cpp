#include "reference/mean_emission.h"

#include <algorithm>

#include "reference/knot_splits.h"

namespace nacre {
namespace {

double mean(const BernsteinCubic& f) { return 0.25 * ((f.b[0] + f.b[3]) + (f.b[1] + f.b[2])); }

/// The mean of T(f) where f keeps to one linear piece of T, so that T(mean f) is it. Rounding may
/// put single values of f a hair beyond the piece's knots; its mean lies inside.
double mean_within_piece(const EmissionMap& map, const BernsteinCubic& f) { return map(mean(f)); }

}  // namespace

double mean_emission(const EmissionMap& map, const BernsteinCubic& f) {
  const auto [least, greatest] = std::minmax_element(f.b.begin(), f.b.end());
  if (!any_knot_between(map, *least, *greatest)) return mean_within_piece(map, f);

  double sum = 0.0;
  for_each_piece(map, f, [&](double s0, double s1, std::size_t) {
    if (s0 < s1) sum += (s1 - s0) * mean_within_piece(map, restrict_to(f, s0, s1));
  });
  return sum;
}

}  // namespace nacre
