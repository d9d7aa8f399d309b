#include "shells/placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/camera.h"
#include "core/error.h"
#include "reference/exact_picture.h"

namespace nacre {
namespace {

// Groups are cut where they hold this part of the pixels or span this part of the range.
constexpr double kMostGroups = 2048.0;

/// Sums over the groups before each: costs of runs of groups in constant time.
class RunCosts {
 public:
  explicit RunCosts(std::span<const ValueGroup> groups) : before_(groups.size() + 1) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
      before_[i + 1] = {0.0, 0.0, before_[i].count + groups[i].count,
                        before_[i].sum + groups[i].sum, before_[i].squares + groups[i].squares};
    }
  }

  /// Squared error of groups [begin, end) shown as their mean.
  double around_mean(std::size_t begin, std::size_t end) const {
    const ValueGroup run = between(begin, end);
    return run.count > 0.0 ? std::max(run.squares - run.sum * run.sum / run.count, 0.0) : 0.0;
  }
  /// Squared error of the first groups shown as 0.
  double as_zero(std::size_t end) const { return before_[end].squares; }

 private:
  ValueGroup between(std::size_t begin, std::size_t end) const {
    return {0.0, 0.0, before_[end].count - before_[begin].count,
            before_[end].sum - before_[begin].sum, before_[end].squares - before_[begin].squares};
  }
  std::vector<ValueGroup> before_;
};

/// One layer more: the least cost of groups [0, end), the last layer beginning at `split(end)`.
/// Costs of runs obey the quadrangle inequality, so that splits do not fall as the end rises, and
/// the middle end's split bounds those of both halves.
class LayerStep {
 public:
  LayerStep(const RunCosts& costs, const std::vector<double>& previous,
            std::vector<std::uint32_t>& split)
      : costs_(costs), previous_(previous), next_(previous.size()), split_(split) {
    split_.assign(previous.size(), 0);
    fill(0, previous.size() - 1, 0, previous.size() - 1);
  }
  std::vector<double> take() { return std::move(next_); }

 private:
  void fill(std::size_t first, std::size_t last, std::size_t least, std::size_t most) {
    const std::size_t end = first + (last - first) / 2;
    double best = std::numeric_limits<double>::infinity();
    std::size_t at = least;
    for (std::size_t begin = least; begin <= std::min(most, end); ++begin) {
      const double cost = previous_[begin] + costs_.around_mean(begin, end);
      if (cost < best) {
        best = cost;
        at = begin;
      }
    }
    next_[end] = best;
    split_[end] = static_cast<std::uint32_t>(at);
    if (end > first) fill(first, end - 1, least, at);
    if (end < last) fill(end + 1, last, at, most);
  }

  const RunCosts& costs_;
  const std::vector<double>& previous_;
  std::vector<double> next_;
  std::vector<std::uint32_t>& split_;
};

/// Where the layers begin, as indices of groups: the optimum.
std::vector<std::size_t> optimal_splits(std::span<const ValueGroup> groups, std::size_t count) {
  const RunCosts costs(groups);
  std::vector<double> cost(groups.size() + 1);
  for (std::size_t end = 0; end < cost.size(); ++end) cost[end] = costs.as_zero(end);
  std::vector<std::vector<std::uint32_t>> split(count);
  for (std::size_t layer = 0; layer < count; ++layer) {
    cost = LayerStep(costs, cost, split[layer]).take();
  }
  std::vector<std::size_t> begins(count);
  std::size_t end = groups.size();
  for (std::size_t layer = count; layer-- > 0;) {
    end = split[layer][end];
    begins[layer] = end;
  }
  return begins;
}

/// The mean of the groups [begin, end), which are not empty.
double mean(std::span<const ValueGroup> groups, std::size_t begin, std::size_t end) {
  double count = 0.0;
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    count += groups[i].count;
    sum += groups[i].sum;
  }
  return sum / count;
}

/// The middle of a layer, what sums show; the full emission of the last one.
void show_middles(std::vector<Level>& levels) {
  for (std::size_t k = 0; k < levels.size(); ++k) {
    levels[k].sum_representative =
        k + 1 < levels.size() ? 0.5 * (levels[k].emission + levels[k + 1].emission) : 1.0;
  }
}

/// Directions spread evenly over a hemisphere (Gonzalez 2010, "Measurement of areas on a sphere
/// using Fibonacci and latitude-longitude lattices").
CameraOptions direction_camera(const HistogramOptions& options, int index) {
  const double height = (index + 0.5) / options.directions;
  CameraOptions camera;
  camera.size = {options.size, options.size};
  camera.azimuth_rad =
      std::fmod(index * std::numbers::pi * (3.0 - std::sqrt(5.0)), 2.0 * std::numbers::pi);
  camera.elevation_rad = std::asin(height);
  return camera;
}

}  // namespace

MaximumHistogram make_histogram(std::vector<double> emissions) {
  std::erase_if(emissions, [](double emission) { return !(emission > 0.0); });
  std::sort(emissions.begin(), emissions.end());
  MaximumHistogram histogram;
  if (emissions.empty()) return histogram;
  const double most_count = static_cast<double>(emissions.size()) / kMostGroups;
  const double most_width = (emissions.back() - emissions.front()) / kMostGroups;
  for (const double emission : emissions) {
    const bool fits =
        !histogram.groups.empty() && (emission == histogram.groups.back().greatest ||
                                      (histogram.groups.back().count < most_count &&
                                       emission - histogram.groups.back().least < most_width));
    if (!fits) histogram.groups.push_back({emission, emission});
    ValueGroup& group = histogram.groups.back();
    group.greatest = emission;
    group.count += 1.0;
    group.sum += emission;
    group.squares += emission * emission;
  }
  return histogram;
}

MaximumHistogram maximum_histogram(const ExactWalk& walk, const BoundingSphere& sphere,
                                   const HistogramOptions& options) {
  std::vector<double> lit;
  ProgressMeter progress(options.progress, "directions",
                         static_cast<std::size_t>(options.directions));
  for (int i = 0; i < options.directions; ++i) {
    const Image image =
        exact_picture(walk, make_camera(direction_camera(options, i), sphere)).volume;
    for (const float pixel : image.pixels) {
      if (pixel > 0.0F) lit.push_back(pixel);
    }
    progress.advance();
  }
  return make_histogram(std::move(lit));
}

std::vector<Level> optimal_levels(const MaximumHistogram& histogram, std::size_t count) {
  const auto& groups = histogram.groups;
  if (groups.empty()) return uniform_levels(count);
  if (count < 1) throw Error(ErrorCode::BadArgument, "levels: found 0, expected at least 1");
  const std::vector<std::size_t> begins = optimal_splits(groups, std::min(count, groups.size()));
  std::vector<Level> levels;
  double below = 0.0;
  for (std::size_t k = 0; k < begins.size(); ++k) {
    const std::size_t end = k + 1 < begins.size() ? begins[k + 1] : groups.size();
    if (begins[k] >= end) continue;
    const double shown = mean(groups, begins[k], end);
    // Any level between the groups will do for them; the middle is best for what they do not show.
    const double gap_begin = begins[k] > 0 ? groups[begins[k] - 1].greatest : 0.0;
    const double middle =
        std::clamp(0.5 * (below + shown), std::nextafter(gap_begin, 1.0), groups[begins[k]].least);
    levels.push_back({.emission = middle, .representative = shown});
    below = shown;
  }
  show_middles(levels);
  return levels;
}

std::vector<Level> with_mean_representatives(std::span<const Level> levels,
                                             const MaximumHistogram& histogram) {
  std::vector<Level> placed(levels.begin(), levels.end());
  show_middles(placed);
  for (std::size_t k = 0; k < placed.size(); ++k) {
    const double end =
        k + 1 < placed.size() ? placed[k + 1].emission : std::numeric_limits<double>::infinity();
    double count = 0.0;
    double sum = 0.0;
    for (const ValueGroup& group : histogram.groups) {
      if (group.least < placed[k].emission || group.least >= end) continue;
      count += group.count;
      sum += group.sum;
    }
    placed[k].representative = count > 0.0
                                   ? std::clamp(sum / count, placed[k].emission, std::min(end, 1.0))
                                   : *placed[k].sum_representative;
  }
  return placed;
}

double predicted_error(std::span<const Level> levels, const MaximumHistogram& histogram) {
  double count = 0.0;
  double squared = 0.0;
  std::size_t k = 0;
  for (const ValueGroup& group : histogram.groups) {
    while (k < levels.size() && levels[k].emission <= group.least) ++k;
    const double shown = k > 0 ? levels[k - 1].representative : 0.0;
    count += group.count;
    squared += group.squares - 2.0 * shown * group.sum + shown * shown * group.count;
  }
  return count > 0.0 ? std::max(squared, 0.0) / count : 0.0;
}

}  // namespace nacre
