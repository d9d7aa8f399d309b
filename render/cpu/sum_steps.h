#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "render/cpu/cluster_kernel.h"
#include "render/cpu/plan_drawing.h"
#include "render/plan.h"
#include "render/ray_frame.h"

namespace nacre {

/// The steps in which the crossings of a pass of sums or counts add up: small enough for the last
/// digit that a float has of the largest crossing, large enough that no crossing and no pixel
/// overflows. Whole numbers, so that sums do not depend on the order of their terms.
class SumSteps {
 public:
  SumSteps(const Pass& pass, const SceneMeshes& scene, const RayFrame& rays);

  /// What one step is worth: of B(d) / |way| (see `RayFrame`) for integrals, of emission else.
  double step() const { return step_; }

  bool is_integral() const { return sum_; }

  Brightness<std::int64_t> of(const ShellDraw& draw) const;

 private:
  bool sum_;
  glm::dvec2 cue_;
  double reach_mm_ = 0.0;
  double step_ = 1.0;
};

}  // namespace nacre
