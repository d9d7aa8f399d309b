#include "app/level_placement.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/volume_geometry.h"
#include "shells/placement.h"

namespace nacre {
namespace {

// Optimal levels are taken where they gain more than this: uniform ones serve sums best.
constexpr double kGainThatPays = 1.0;  // dB

double psnr_db(double squared_error) { return -10.0 * std::log10(std::max(squared_error, 1e-30)); }

/// The better of uniform and optimal levels, as the flag says; tells what was gained.
PlacedLevels choose(const LevelFlags& flags, const std::vector<Level>& uniform,
                    const MaximumHistogram& histogram, Reporter& reporter,
                    nlohmann::ordered_json& figures) {
  std::vector<Level> optimal = optimal_levels(histogram, uniform.size());
  const double uniform_db = psnr_db(predicted_error(uniform, histogram));
  const double optimal_db = psnr_db(predicted_error(optimal, histogram));
  const double gain = optimal_db - uniform_db;
  figures = {{"predicted_uniform_db", uniform_db}, {"predicted_optimal_db", optimal_db}};
  if (flags.placement != "optimal" && !(gain > kGainThatPays)) {
    reporter.detail(fmt::format(
        "levels uniform: optimal ones would gain {:.1f} dB over lit pixels of ideal shells", gain));
    return {uniform, "uniform"};
  }
  reporter.say(fmt::format(
      "levels optimal: {:.1f} dB over lit pixels of ideal shells' maximum projections, {:+.1f} dB "
      "against uniform ones{}",
      optimal_db, gain,
      flags.placement == "auto" ? " (chosen; --placement uniform overrides)" : ""));
  if (optimal.size() < uniform.size()) {
    reporter.say(
        fmt::format("  {} levels: the projections show no more emissions", optimal.size()));
  }
  return {std::move(optimal), "optimal"};
}

}  // namespace

const MaximumHistogram& LevelPlacer::histogram(Reporter& reporter) {
  if (!histogram_) {
    const Volume& volume = input_.volume;
    histogram_ = maximum_histogram(ExactWalk(volume, input_.emission),
                                   bounding_sphere(volume.dims, volume.world_from_voxel),
                                   {.progress = reporter.progress()});
  }
  return *histogram_;
}

PlacedLevels LevelPlacer::place(const LevelFlags& flags, Reporter& reporter,
                                nlohmann::ordered_json& figures) {
  std::vector<Level> levels = levels_of(flags, input_.emission);
  if (!are_placed(flags)) {
    return {with_mean_representatives(levels, histogram(reporter)), "explicit"};
  }
  if (flags.placement == "uniform") return {std::move(levels), "uniform"};
  if (histogram(reporter).groups.empty()) return {std::move(levels), "uniform"};
  return choose(flags, levels, histogram(reporter), reporter, figures);
}

}  // namespace nacre
