#include "app/shell_building.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "app/flag_values.h"
#include "core/error.h"
#include "core/volume_geometry.h"
#include "extract/levels.h"
#include "shells/build.h"
#include "shells/placement.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

// Optimal levels are taken where they gain more than this: uniform ones also serve sums best.
constexpr double kGainThatPays = 1.0;  // dB
// A component of less than a quarter of a voxel is one voxel barely above its level.
constexpr double kSpeckVoxels = 0.25;

/// "24" is a count; "0.2", "1" with other numbers and anything with a comma or a point are
/// emissions.
bool is_count(const std::string& text) {
  return text.find_first_not_of("0123456789") == std::string::npos;
}

/// Emissions that were asked for one by one; none if a count was.
std::vector<Level> listed_levels(const ShellFlags& flags, const EmissionMap& emission) {
  if (!flags.level_values.empty()) {
    std::vector<double> emissions =
        parse_numbers("--level-values", flags.level_values, 0, "v1,v2,... in the volume's values");
    for (double& value : emissions) value = emission(value);
    return explicit_levels(emissions);
  }
  if (is_count(flags.levels)) return {};
  return explicit_levels(parse_numbers("--levels", flags.levels, 0, "N or t1,t2,..."));
}

std::size_t level_count(const ShellFlags& flags) {
  constexpr long long kMostLevels = 1000;
  const long long count = parse_integers("--levels", flags.levels, 1, "N or t1,t2,...").front();
  if (count < 1 || count > kMostLevels) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("--levels: found {}, expected 1 to {}", count, kMostLevels));
  }
  return static_cast<std::size_t>(count);
}

/// Levels, and how they were found.
struct Placement {
  std::vector<Level> levels;
  std::string name;
};

double psnr_db(double squared_error) { return -10.0 * std::log10(std::max(squared_error, 1e-30)); }

/// The better of uniform and optimal levels, as the flag says; tells what was gained.
Placement place(const ShellFlags& flags, std::size_t count, const MaximumHistogram& histogram,
                Reporter& reporter, ordered_json& figures) {
  const std::vector<Level> uniform = uniform_levels(count);
  std::vector<Level> optimal = optimal_levels(histogram, count);
  const double uniform_db = psnr_db(predicted_error(uniform, histogram));
  const double optimal_db = psnr_db(predicted_error(optimal, histogram));
  const double gain = optimal_db - uniform_db;
  figures = {{"predicted_uniform_db", uniform_db}, {"predicted_optimal_db", optimal_db}};
  const bool pays = gain > kGainThatPays && !histogram.groups.empty();
  if (flags.placement != "optimal" && !pays) {
    reporter.detail(fmt::format(
        "levels uniform: optimal ones would gain {:.1f} dB over lit pixels of ideal shells", gain));
    return {uniform, "uniform"};
  }
  reporter.say(fmt::format(
      "levels optimal: {:.1f} dB over lit pixels of ideal shells' maximum projections, {:+.1f} dB "
      "against uniform ones{}",
      optimal_db, gain,
      flags.placement == "auto" ? " (chosen; --placement uniform overrides)" : ""));
  if (optimal.size() < count) {
    reporter.say(
        fmt::format("  {} levels suffice: the projections show no more emissions", optimal.size()));
  }
  return {std::move(optimal), "optimal"};
}

Placement placement_of(const ShellFlags& flags, const EmissionVolume& input, Reporter& reporter,
                       ordered_json& figures) {
  const std::vector<Level> listed = listed_levels(flags, input.emission);
  if (listed.empty() && flags.placement == "uniform") {
    return {uniform_levels(level_count(flags)), "uniform"};
  }
  const std::size_t count = listed.empty() ? level_count(flags) : 0;
  const ExactWalk walk(input.volume, input.emission);
  const MaximumHistogram histogram =
      maximum_histogram(walk, bounding_sphere(input.volume.dims, input.volume.world_from_voxel),
                        {.progress = reporter.progress()});
  if (!listed.empty()) return {with_mean_representatives(listed, histogram), "explicit"};
  return place(flags, count, histogram, reporter, figures);
}

double voxel_mm3(const Volume& volume) {
  const glm::dmat4& m = volume.world_from_voxel;
  return std::abs(glm::dot(glm::dvec3(m[0]), glm::cross(glm::dvec3(m[1]), glm::dvec3(m[2]))));
}

double least_component_mm3(const ShellFlags& flags, const Volume& volume) {
  if (flags.keep_specks) return 0.0;
  return flags.min_component.value_or(kSpeckVoxels * voxel_mm3(volume));
}

ordered_json left_out_item(const ComponentCount& count, const std::string& what,
                           const std::string& why) {
  return {{"what", fmt::format("{} {}", count.components, what)},
          {"why", why},
          {"components", count.components},
          {"triangles", count.triangles},
          {"volume_mm3", count.volume_mm3}};
}

/// What was pruned, in words and figures.
void tell_pruning(const Pruning& pruned, Reporter& reporter, ordered_json& left_out) {
  if (pruned.specks.components > 0) {
    ordered_json specks =
        left_out_item(pruned.specks, "specks",
                      fmt::format("components of less than {:.4g} mm3 (--keep-specks keeps them)",
                                  pruned.min_component_mm3));
    specks["largest_emission"] = pruned.largest_emission;
    left_out.push_back(std::move(specks));
    reporter.say(fmt::format(
        "left out {} specks of less than {:.4g} mm3: {} triangles, {:.4g} mm3, at most {:.3f} of "
        "emission in a pixel (--keep-specks keeps them)",
        pruned.specks.components, pruned.min_component_mm3, pruned.specks.triangles,
        pruned.specks.volume_mm3, pruned.largest_emission));
  }
  if (pruned.inner.components > 0) {
    left_out.push_back(
        left_out_item(pruned.inner, "inner components",
                      "inside their own shell's surface, where no maximum projection "
                      "without a slab shows them (--purpose all keeps them)"));
    reporter.say(fmt::format(
        "left out {} components inside their own shell: {} triangles, {:.4g} mm3 (no maximum "
        "projection shows them; --purpose all keeps them, for sums and slabs)",
        pruned.inner.components, pruned.inner.triangles, pruned.inner.volume_mm3));
  }
}

/// How neighbours meet, in words and figures.
ordered_json tell_nesting(const std::vector<NeighbourCrossings>& crossings, Reporter& reporter) {
  std::size_t pairs = 0;
  std::size_t crossing = 0;
  std::size_t impossible = 0;
  ordered_json list = ordered_json::array();
  for (const NeighbourCrossings& neighbours : crossings) {
    pairs += neighbours.pairs;
    crossing += neighbours.pairs > 0 ? 1 : 0;
    impossible += neighbours.impossible ? 1 : 0;
    list.push_back({{"outer", neighbours.outer + 1},
                    {"inner", neighbours.inner + 1},
                    {"impossible", neighbours.impossible},
                    {"crossing_pairs", neighbours.pairs}});
  }
  if (!crossings.empty()) {
    reporter.say(fmt::format(
        "nesting: {} pairs of triangles cross, in {} of {} neighbours; crossings impossible in {}",
        pairs, crossing, crossings.size(), impossible));
  }
  return {{"crossing_pairs", pairs}, {"neighbours", list}};
}

}  // namespace

ShellSet build_shell_set(const ShellFlags& flags, EmissionVolume input, Reporter& reporter,
                         BuildFigures& figures) {
  Stopwatch placing;
  Placement placement = placement_of(flags, input, reporter, figures.placement);
  figures.emission = placing.lap();
  BuildOptions options;
  options.levels = std::move(placement.levels);
  options.placement = placement.name;
  options.emission_tolerance = flags.tolerance;
  options.tolerance_mm = flags.tolerance_mm;
  options.quantization_bits = flags.quantization;
  options.min_component_mm3 = least_component_mm3(flags, input.volume);
  options.prune_inner = flags.purpose == "max";
  options.progress = reporter.progress();
  BuiltShells built = build_shells(std::move(input.volume), input.emission, options);
  if (built.report.is_grid_coarse) {
    reporter.warn(
        fmt::format("the quantisation step is {:.3g} of the smallest spacing, more than "
                    "1/64: more bits would be needed",
                    built.report.step_spacings));
  }
  tell_pruning(built.set.pruned, reporter, figures.left_out);
  figures.nesting = tell_nesting(built.report.crossings, reporter);
  figures.extract = built.report.extract_seconds;
  figures.simplify =
      built.report.prune_seconds + built.report.simplify_seconds + built.report.snap_seconds;
  figures.crossings = built.report.crossings_seconds;
  figures.extracted_triangles = built.report.extracted_triangles;
  return std::move(built.set);
}

}  // namespace nacre
