#pragma once

#include "core/shell_set.h"
#include "io/shell_writer.h"

namespace nacre::testing {

/// A mesh with its positions moved to the nearest points of a grid.
TriangleMesh on_grid(const QuantizationGrid& grid, TriangleMesh mesh);

/// Four levels: a sphere, two spheres, a torus, and one that nothing reaches, on an exact grid,
/// with numbers in its description that decimal digits do not hold.
ShellSet small_shell_set();

/// Coarse copies of its two outer shells: spheres and pairs of spheres of fewer triangles.
ShellSet small_coarse_set();

/// The small set with these copies, as a file.
std::vector<std::byte> small_file_with_copies();

}  // namespace nacre::testing
