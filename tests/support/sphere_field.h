#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "shells/surface_field.h"

namespace nacre::testing {

/// Distance from a sphere about the origin, signed, as the field a surface should be a zero of.
struct SphereField {
  double radius;

  FieldSample operator()(const glm::dvec3& p) const {
    const double r = glm::length(p);
    return {r - radius, r > 0.0 ? p / r : glm::dvec3(0.0)};
  }
};

}  // namespace nacre::testing
