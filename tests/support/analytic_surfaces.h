#pragma once

#include <glm/vec3.hpp>

#include "core/triangle_mesh.h"

namespace nacre::testing {

/// The cube [-h, h]^3, each side cut into `cells` x `cells` squares of two triangles. Closed,
/// counter-clockwise seen from outside: 12 cells^2 triangles, 6 cells^2 + 2 vertices.
TriangleMesh cube_surface(float half_side, int cells = 1);

/// A sphere about the origin: `cube_surface` drawn to the radius. The mesh is inscribed.
TriangleMesh sphere_surface(float radius, int cells);

/// A torus about the z axis: `major` segments around the axis, `minor` around the tube.
TriangleMesh torus_surface(float major_radius, float minor_radius, int major, int minor);

/// Both meshes as one, without joining them.
TriangleMesh together(TriangleMesh first, const TriangleMesh& second);

/// The mesh moved by an offset.
TriangleMesh moved(TriangleMesh mesh, const glm::vec3& offset);

/// The mesh with inside and outside exchanged.
TriangleMesh turned_inside_out(TriangleMesh mesh);

}  // namespace nacre::testing
