#pragma once

#include <cstddef>
#include <vector>

#include "core/camera.h"
#include "core/picture.h"
#include "core/shell_set.h"
#include "core/tool.h"

namespace nacre::testing {

/// A part of a ray between crossings: within `shells` shells all along.
struct ShellSegment {
  double t_begin = 0.0;
  double t_end = 0.0;
  std::size_t shells = 0;
};

/// The parts of a line within shells, by brute force and sorting (Moller and Trumbore 1997), for
/// shells that are closed and nested. Lines through edges are not for it.
std::vector<ShellSegment> shell_segments(const ShellSet& set, const Ray& ray);

/// Where a ray first meets a tool for t >= from, by brute force; infinity if nowhere.
double first_tool_mm(const Tool& tool, const Ray& ray, double from_mm);

/// The parts within an interval.
std::vector<ShellSegment> clip(std::vector<ShellSegment> segments, const RayInterval& interval);

/// The largest cued emission of the piecewise constant emission, and its cued integral (in long
/// double), from the parts of a ray: what pictures of shells should show.
double segment_maximum(const ShellSet& set, const std::vector<ShellSegment>& segments,
                       const Camera& camera, const DepthCue& cue, const Ray& ray);
double segment_integral(const ShellSet& set, const std::vector<ShellSegment>& segments,
                        const Camera& camera, const DepthCue& cue, const Ray& ray);

}  // namespace nacre::testing
