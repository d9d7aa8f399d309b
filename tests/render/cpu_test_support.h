#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "core/camera.h"
#include "core/shell_set.h"
#include "core/volume_geometry.h"

namespace nacre::testing {

/// Marching cubes of a small angiogram: thin vessels, triangles below a pixel in size.
struct Scan {
  ShellSet set;
  BoundingSphere sphere;
};

Scan small_angiogram();

/// Orthographic, zoomed, perspective, and from within.
std::vector<Camera> cameras(const BoundingSphere& sphere, const glm::ivec2& size);

}  // namespace nacre::testing
