#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace nacre {

/// The corners of a triangle, points of a grid of at most 23 bits.
using GridTriangle = std::array<glm::ivec3, 3>;

/// Whether two triangles cross: they meet, each with corners on both sides of the other. Exact.
bool cross(const GridTriangle& s, const GridTriangle& t);

}  // namespace nacre
