#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace nacre {

/// The grid of a phantom: `size` voxels that together fill a box of `extent_mm` about the world's
/// origin, axes along LPS. Samples lie at the voxels' centres; spacing = extent / size.
glm::dmat4 centered_grid(const glm::i64vec3& size, const glm::dvec3& extent_mm);

}  // namespace nacre
