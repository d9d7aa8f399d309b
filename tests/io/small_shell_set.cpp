#include "tests/io/small_shell_set.h"

#include <cmath>

#include "core/quantization_grid.h"
#include "tests/support/analytic_surfaces.h"

namespace nacre::testing {

TriangleMesh on_grid(const QuantizationGrid& grid, TriangleMesh mesh) {
  for (glm::vec3& p : mesh.positions) p = grid_position(grid, nearest_index(grid, p));
  return mesh;
}

ShellSet small_shell_set() {
  ShellSet set;
  set.volume.dims = {17, 18, 19};
  set.volume.world_from_voxel = glm::dmat4(1.0 / 3.0, 1e-3, 0, 0, -1e-3, 0.7, 0, 0, 0, 0, M_PI, 0,
                                           -1.0 / 7.0, 1e5 / 3.0, 2.2250738585072014e-308, 1);
  set.volume.type = ScalarType::I16;
  set.volume.slope = 1.0 / 255.0;
  set.volume.intercept = -1024.1;
  set.volume.checksum = 0xfedcba9876543210ULL;
  set.center_mm = {1.0 / 3.0, -2.0 / 3.0, 1e5 / 7.0};
  set.emission = {{-100.0 / 3.0, 0.0}, {0.1, 0.25}, {1e3 / 7.0, 1.0}};
  set.placement = "explicit";
  set.tolerance = 0.01;
  set.tolerance_weight = ToleranceWeight::Picture;
  const double step = 5.0 / 1024.0;
  set.grid = QuantizationGrid{glm::dvec3(-2048.0 * step), 4095.0 * step, 12};

  const TriangleMesh two = together(moved(sphere_surface(2.0f, 6), {-4.0f, 0.0f, 0.0f}),
                                    moved(sphere_surface(3.0f, 5), {4.0f, 0.0f, 0.0f}));
  set.shells = {{0.1, 1.0 / 3.0, 0.25, on_grid(*set.grid, sphere_surface(8.0f, 7))},
                {1.0 / 3.0, 2.0 / 3.0, 0.5, on_grid(*set.grid, two)},
                {0.5, 7.0, 0.75, on_grid(*set.grid, torus_surface(4.0f, 1.0f, 24, 12))},
                {1.0, 1e3 / 7.0, 1.0, {}}};
  return set;
}

ShellSet small_coarse_set() {
  ShellSet set = small_shell_set();
  const TriangleMesh two = together(moved(sphere_surface(2.0f, 3), {-4.0f, 0.0f, 0.0f}),
                                    moved(sphere_surface(3.0f, 3), {4.0f, 0.0f, 0.0f}));
  set.shells[0].surface = on_grid(*set.grid, sphere_surface(8.0f, 3));
  set.shells[1].surface = on_grid(*set.grid, two);
  set.shells[2].surface = {};
  return set;
}

std::vector<std::byte> small_file_with_copies() {
  CoarseShells coarse{.tolerance = 0.1,
                      .max_error_json = R"({"psnr_db":40.5})",
                      .max_fine_error_json = R"({"psnr_db":41.5})",
                      .sum_error_json = R"({"psnr_db":50.5})"};
  for (Shell& shell : small_coarse_set().shells) {
    coarse.shells.push_back(compress_shell(std::move(shell.surface), *small_shell_set().grid));
  }
  return encode_shell_set(small_shell_set(), {.coarse = std::move(coarse)});
}

}  // namespace nacre::testing
