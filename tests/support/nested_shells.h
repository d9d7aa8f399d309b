#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/shell_set.h"

namespace nacre::testing {

/// A closed sphere of 2 * rings * (rings - 1) * 2 triangles, poles on the z axis.
TriangleMesh ball_mesh(const glm::dvec3& center, double radius, int rings);

/// A closed box of 12 triangles.
TriangleMesh block_mesh(const glm::dvec3& lo, const glm::dvec3& hi);

/// A closed torus about the z axis, 2 * rings^2 triangles.
TriangleMesh ring_mesh(const glm::dvec3& center, double major_radius, double minor_radius,
                       int rings);

/// Two meshes as one.
TriangleMesh join(TriangleMesh a, const TriangleMesh& b);

/// A mesh times a factor, about the origin.
TriangleMesh scaled(TriangleMesh mesh, float factor);

/// A ring and, beside it, a smaller one.
TriangleMesh two_rings();

/// A set of these surfaces, outermost first, with the representatives k / n.
ShellSet make_set(std::vector<TriangleMesh> surfaces, const glm::dvec3& center_mm = {});

/// Balls of radius `radius`, radius (n - 1) / n, ... about the set's centre.
ShellSet nested_balls(int shells, double radius, int rings, const glm::dvec3& center_mm = {});

/// A ball with a block sticking out, a ring in it and a small block: no symmetry left.
ShellSet mixed_set(const glm::dvec3& center_mm);

}  // namespace nacre::testing
