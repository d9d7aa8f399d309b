#include "extract/emission_volume.h"

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/error.h"

namespace nacre {
namespace {

bool never_falls(const std::vector<EmissionKnot>& knots) {
  return std::is_sorted(knots.begin(), knots.end(),
                        [](const auto& a, const auto& b) { return a.emission < b.emission; });
}

bool never_rises(const std::vector<EmissionKnot>& knots) {
  return std::is_sorted(knots.rbegin(), knots.rend(),
                        [](const auto& a, const auto& b) { return a.emission < b.emission; });
}

/// The map of -value.
std::vector<EmissionKnot> mirrored(std::vector<EmissionKnot> knots) {
  std::reverse(knots.begin(), knots.end());
  for (EmissionKnot& knot : knots) knot.value = -knot.value;
  return knots;
}

/// Values strictly rising and emissions in range: what piecewise_linear would check were the
/// emissions rising.
void check(const std::vector<EmissionKnot>& knots) {
  std::vector<EmissionKnot> rising = knots;
  std::sort(rising.begin(), rising.end(),
            [](const auto& a, const auto& b) { return a.emission < b.emission; });
  for (std::size_t i = 0; i < rising.size(); ++i) rising[i].value = knots[i].value;
  EmissionMap::piecewise_linear(std::move(rising));
}

/// Linear between knots, constant beyond.
double map_value(std::span<const EmissionKnot> knots, double value) {
  if (!(value > knots.front().value)) return knots.front().emission;
  if (value >= knots.back().value) return knots.back().emission;
  const auto above =
      std::upper_bound(knots.begin(), knots.end(), value,
                       [](double wanted, const EmissionKnot& knot) { return wanted < knot.value; });
  const EmissionKnot& a = *(above - 1);
  const double s = (0.5 * value - 0.5 * a.value) / (0.5 * above->value - 0.5 * a.value);
  return a.emission * (1.0 - s) + above->emission * s;
}

Volume applied(const Volume& volume, std::span<const EmissionKnot> knots) {
  Volume result = make_volume(volume.dims, ScalarType::F32);
  result.world_from_voxel = volume.world_from_voxel;
  const std::span<float> out = samples_as<float>(result);
  visit_samples(volume, [&](auto samples) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples.size()), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const double value = volume.slope * static_cast<double>(samples[i]) + volume.intercept;
        out[i] = static_cast<float>(map_value(knots, value));
      }
    });
  });
  return result;
}

}  // namespace

EmissionVolume map_volume(Volume volume, std::vector<EmissionKnot> knots) {
  check(knots);
  if (never_falls(knots)) {
    return {std::move(volume), EmissionMap::piecewise_linear(std::move(knots))};
  }
  if (never_rises(knots)) {
    volume.slope = -volume.slope;
    volume.intercept = -volume.intercept;
    return {std::move(volume), EmissionMap::piecewise_linear(mirrored(std::move(knots)))};
  }
  Volume emission = applied(volume, knots);
  return {std::move(emission), EmissionMap::window(0.0, 1.0)};
}

}  // namespace nacre
