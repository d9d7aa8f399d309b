#pragma once

#include <functional>
#include <glm/vec3.hpp>

namespace nacre {

/// What a surface should be a zero of, at a point: how far off it is, signed, and how that changes.
struct FieldSample {
  double error;
  glm::dvec3 gradient;  ///< of `error`, per mm; 0 where the point may not move
};

/// A field whose zero set a surface follows, at points of the surface's own frame in mm.
using SurfaceField = std::function<FieldSample(const glm::dvec3& p_mm)>;

}  // namespace nacre
