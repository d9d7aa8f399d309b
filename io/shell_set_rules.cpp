#include "io/shell_set_rules.h"

#include <fmt/core.h>

#include <cmath>

#include "core/error.h"
#include "core/quantization_grid.h"

namespace nacre {
namespace {

using Objection = std::optional<std::string>;

Objection object_to_volume(const VolumeFacts& volume) {
  for (int axis = 0; axis < 3; ++axis) {
    if (volume.dims[axis] < 1) {
      return fmt::format("found a volume of {} x {} x {} samples, expected at least 1 an axis",
                         volume.dims.x, volume.dims.y, volume.dims.z);
    }
  }
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      const double x = volume.world_from_voxel[column][row];
      const bool sound = row < 3 ? std::isfinite(x) : x == (column == 3 ? 1.0 : 0.0);
      if (!sound) {
        return fmt::format(
            "found {} in row {} of world_from_voxel, expected a finite affine matrix", x, row);
      }
    }
  }
  if (!std::isfinite(volume.slope) || volume.slope == 0.0 || !std::isfinite(volume.intercept)) {
    return fmt::format("found slope {} and intercept {}, expected finite ones, the slope not 0",
                       volume.slope, volume.intercept);
  }
  return std::nullopt;
}

Objection object_to_levels(const std::vector<Shell>& shells) {
  double below = 0.0;
  for (std::size_t k = 0; k < shells.size(); ++k) {
    const Shell& shell = shells[k];
    if (!(shell.emission > below && shell.emission <= 1.0)) {
      return fmt::format(
          "found level {} at emission {} after {}, expected ascending ones above 0 "
          "and up to 1",
          k, shell.emission, below);
    }
    below = shell.emission;
    if (!std::isfinite(shell.value)) {
      return fmt::format("found level {} at value {}, expected a finite one", k, shell.value);
    }
    for (const double shown : {shell.representative, sum_representative(shell)}) {
      if (!(shown >= 0.0 && shown <= 1.0)) {
        return fmt::format("found level {} shown as {}, expected 0 to 1", k, shown);
      }
    }
  }
  return std::nullopt;
}

Objection object_to_pruning(const Pruning& pruned) {
  for (const double number : {pruned.min_component_mm3, pruned.largest_emission,
                              pruned.specks.volume_mm3, pruned.inner.volume_mm3}) {
    if (!(number >= 0.0 && std::isfinite(number))) {
      return fmt::format("found {} for what was pruned, expected 0 or more", number);
    }
  }
  return std::nullopt;
}

Objection object_to_emission(const std::vector<EmissionKnot>& knots) {
  try {
    EmissionMap::piecewise_linear(knots);
  } catch (const Error& error) {
    // "emission map: found ..., expected ..."
    const std::string what = error.what();
    return what.substr(what.find("found"));
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> shell_set_objection(const ShellSet& set) {
  if (auto objection = object_to_volume(set.volume)) return objection;
  if (auto objection = object_to_emission(set.emission)) return objection;
  if (auto objection = object_to_levels(set.shells)) return objection;
  if (auto objection = object_to_pruning(set.pruned)) return objection;
  if (set.placement != "uniform" && set.placement != "optimal" && set.placement != "explicit") {
    return fmt::format("found placement '{:.40}', expected uniform, optimal or explicit",
                       set.placement);
  }
  if (!(set.tolerance >= 0.0 && std::isfinite(set.tolerance))) {
    return fmt::format("found tolerance {}, expected 0 or more", set.tolerance);
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(set.center_mm[axis])) {
      return fmt::format("found {} in the centre, expected finite numbers", set.center_mm[axis]);
    }
  }
  if (!set.grid || !is_exact(*set.grid)) {
    return "found no grid, or one whose points are not floats, expected an exact grid";
  }
  return std::nullopt;
}

}  // namespace nacre
