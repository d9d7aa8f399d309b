#pragma once

#include <optional>
#include <span>

#include "core/camera.h"
#include "core/picture.h"
#include "core/shell_set.h"
#include "core/tool.h"

namespace nacre::testing {

/// Pixels of a shell picture by brute force, in double, from the definitions alone: each ray is cut
/// into the parts inside each shell, and these are clipped to where the ray starts and ends.
class ShellRays {
 public:
  /// References the set and the tools.
  ShellRays(const ShellSet& set, std::span<const Tool> tools, const Camera& camera,
            const DepthCue& cue = {}, const Slab& slab = {});

  /// Largest beta(z) r_k over the parts inside shell k.
  double maximum(double pixel_x, double pixel_y) const;

  /// Sum over shells of (r_k - r_previous) times the integral of beta over the parts inside.
  double sum(double pixel_x, double pixel_y) const;

  /// Sum of r_k over the crossings between start and end.
  double count(double pixel_x, double pixel_y) const;

  /// headlight times beta at the nearest crossing, with the outward normal of a ball about the
  /// set's centre; 0 without a crossing.
  double lit_ball(double pixel_x, double pixel_y) const;

  /// Depth along the ray of the nearest tool, mm from its origin; infinite without one.
  double tool_t_mm(double pixel_x, double pixel_y) const;

  /// What the tool layer shows there; none where no tool is.
  std::optional<glm::vec3> tool_color(double pixel_x, double pixel_y) const;

 private:
  double cue_at(const Ray& ray, double t_mm) const;
  RayInterval interval(const Ray& ray) const;

  const ShellSet& set_;
  std::span<const Tool> tools_;
  const Camera& camera_;
  DepthCue cue_;
  Slab slab_;
};

}  // namespace nacre::testing
