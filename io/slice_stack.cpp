#include "io/slice_stack.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "io/bad_file.h"

namespace nacre {
namespace {

constexpr double kSameDirection = 1e-4;  // cosines are written with about six digits
constexpr double kSameSpacing = 1e-4;    // relative
constexpr double kSamePlace = 0.01;      // of the usual distance between slices
constexpr double kUnevenWorthAWord = 0.001;
constexpr double kUnevenTooMuch = 0.1;
constexpr double kSidewaysWorthAWord = 0.01;
constexpr double kSidewaysTooMuch = 0.1;

/// Refuses a frame that is none: spacings not positive, directions not of about unit length.
void check_frame(const std::filesystem::path& path, const SliceFrame& slice) {
  if (!(slice.spacing_mm.x > 0.0) || !(slice.spacing_mm.y > 0.0)) {
    throw_bad_file(
        path, fmt::format("a pixel spacing of {} x {} mm", slice.spacing_mm.x, slice.spacing_mm.y),
        "positive ones");
  }
  constexpr double unit_tolerance = 0.01;
  for (const glm::dvec3& direction : {slice.x_direction, slice.y_direction}) {
    if (!(std::abs(glm::length(direction) - 1.0) < unit_tolerance)) {
      throw_bad_file(path, fmt::format("a direction of length {:.3g}", glm::length(direction)),
                     "1");
    }
  }
}

void check_alike(const std::filesystem::path& path, std::span<const SliceFrame> slices) {
  const SliceFrame& first = slices.front();
  for (const SliceFrame& slice : slices) {
    if (glm::length(slice.x_direction - first.x_direction) > kSameDirection ||
        glm::length(slice.y_direction - first.y_direction) > kSameDirection) {
      throw_bad_file(path, "slices of more than one orientation", "parallel slices");
    }
    if (glm::length(slice.spacing_mm - first.spacing_mm) >
        kSameSpacing * glm::length(first.spacing_mm)) {
      throw_bad_file(path, "slices of more than one pixel spacing", "the same in all");
    }
  }
}

/// Distances between neighbours, and the one in the middle when they are sorted.
struct Steps {
  std::vector<double> mm;
  double median_mm = 0.0;
};

Steps steps_between(const std::vector<double>& heights_mm) {
  Steps steps;
  for (std::size_t i = 1; i < heights_mm.size(); ++i) {
    steps.mm.push_back(heights_mm[i] - heights_mm[i - 1]);
  }
  std::vector<double> sorted = steps.mm;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  steps.median_mm = *middle;
  return steps;
}

void check_no_two_share_a_place(const std::filesystem::path& path, const Steps& steps) {
  // Where most positions are shared the median is 0: then the largest step is the measure.
  const double usual_mm =
      std::max(steps.median_mm, kSamePlace * *std::max_element(steps.mm.begin(), steps.mm.end()));
  const auto shared = std::count_if(steps.mm.begin(), steps.mm.end(), [&](double step_mm) {
    return step_mm <= kSamePlace * usual_mm;
  });
  if (shared == 0) return;
  const std::size_t count = steps.mm.size() + 1;
  throw_bad_file(path,
                 fmt::format("{} slices at {} positions (a time series, or several images a slice)",
                             count, count - static_cast<std::size_t>(shared)),
                 "one slice a position");
}

void check_even(const std::filesystem::path& path, const Steps& steps, VolumeReadReport& report) {
  double worst = 0.0;
  for (std::size_t i = 0; i < steps.mm.size(); ++i) {
    const double deviation = std::abs(steps.mm[i] / steps.median_mm - 1.0);
    worst = std::max(worst, deviation);
    if (deviation > kUnevenTooMuch) {
      throw_bad_file(
          path, fmt::format("{:.4g} mm between slices {} and {}", steps.mm[i], i + 1, i + 2),
          fmt::format("{:.4g} mm as between the others (a slice may be missing)", steps.median_mm));
    }
  }
  if (worst > kUnevenWorthAWord) {
    report.warnings.push_back(fmt::format(
        "slice distances differ from their median, {:.6g} mm, by up to {:.2g} %; taken as even",
        steps.median_mm, 100.0 * worst));
  }
}

/// How far, at most, a slice lies beside the line from the first to the last, at its own height.
double largest_stray_mm(std::span<const SliceFrame> slices, const std::vector<std::size_t>& order,
                        const std::vector<double>& heights_mm) {
  const glm::dvec3 first = slices[order.front()].position;
  const glm::dvec3 way = slices[order.back()].position - first;
  double worst = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double t =
        (heights_mm[i] - heights_mm.front()) / (heights_mm.back() - heights_mm.front());
    worst = std::max(worst, glm::length(slices[order[i]].position - first - t * way));
  }
  return worst;
}

void check_straight(const std::filesystem::path& path, double stray_mm, double pixel_mm,
                    VolumeReadReport& report) {
  if (stray_mm > kSidewaysTooMuch * pixel_mm) {
    throw_bad_file(path,
                   fmt::format("slices that lie up to {:.3g} mm beside a straight line", stray_mm),
                   fmt::format("at most a tenth of a pixel, {:.3g} mm", 0.1 * pixel_mm));
  }
  if (stray_mm > kSidewaysWorthAWord * pixel_mm) {
    report.warnings.push_back(
        fmt::format("slices lie up to {:.2g} mm beside a straight line; taken as on it", stray_mm));
  }
}

/// A slice alone has no neighbour to take a distance from.
double lone_slice_step_mm(const SliceFrame& slice, VolumeReadReport& report) {
  const bool known = std::isfinite(slice.thickness_mm) && slice.thickness_mm > 0.0;
  const double step_mm = known ? slice.thickness_mm : 1.0;
  report.warnings.push_back(fmt::format("one slice only: its extent taken as {:.6g} mm ({})",
                                        step_mm, known ? "its thickness" : "nothing is stated"));
  return step_mm;
}

}  // namespace

SliceStack stack_slices(const std::filesystem::path& path, std::span<const SliceFrame> slices,
                        VolumeReadReport& report) {
  for (const SliceFrame& slice : slices) check_frame(path, slice);
  check_alike(path, slices);
  const SliceFrame& any = slices.front();
  const glm::dvec3 x = glm::normalize(any.x_direction);
  const glm::dvec3 y = glm::normalize(any.y_direction);
  const glm::dvec3 normal = glm::normalize(glm::cross(x, y));

  SliceStack stack;
  stack.order.resize(slices.size());
  std::iota(stack.order.begin(), stack.order.end(), std::size_t{0});
  const auto height_mm = [&](std::size_t i) { return glm::dot(slices[i].position, normal); };
  std::stable_sort(stack.order.begin(), stack.order.end(),
                   [&](std::size_t a, std::size_t b) { return height_mm(a) < height_mm(b); });
  const glm::dvec3 first = slices[stack.order.front()].position;
  glm::dvec3 step = normal;
  if (slices.size() > 1) {
    std::vector<double> heights_mm;
    for (const std::size_t i : stack.order) heights_mm.push_back(height_mm(i));
    const Steps steps = steps_between(heights_mm);
    check_no_two_share_a_place(path, steps);
    check_even(path, steps, report);
    check_straight(path, largest_stray_mm(slices, stack.order, heights_mm),
                   std::min(any.spacing_mm.x, any.spacing_mm.y), report);
    step = (slices[stack.order.back()].position - first) / static_cast<double>(slices.size() - 1);
  } else {
    step *= lone_slice_step_mm(any, report);
  }
  stack.world_from_voxel[0] = glm::dvec4(x * any.spacing_mm.x, 0.0);
  stack.world_from_voxel[1] = glm::dvec4(y * any.spacing_mm.y, 0.0);
  stack.world_from_voxel[2] = glm::dvec4(step, 0.0);
  stack.world_from_voxel[3] = glm::dvec4(first, 1.0);
  return stack;
}

}  // namespace nacre
