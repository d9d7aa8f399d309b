#include "shells/border_rounding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>
#include <vector>

#include "core/error.h"
#include "core/quantization_grid.h"
#include "reference/exact_picture.h"
#include "reference/exact_walk.h"
#include "reference/shell_picture.h"
#include "shells/build.h"
#include "shells/certificate.h"
#include "shells/quantization.h"
#include "shells/shell_checks.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

constexpr double kOnPlane = 1e-6;  // voxels: rounding

glm::dmat4 aslant() {
  return glm::rotate(glm::dmat4(1.0), 0.07, glm::dvec3(1, 2, 3)) *
         glm::scale(glm::dmat4(1.0), {0.8, 1.0, 1.3});
}

glm::dmat4 sheared() {
  glm::dmat4 matrix = aslant();
  matrix[1] += 0.3 * matrix[0];
  return matrix;
}

ShellSet set_of(const glm::i64vec3& dims, const glm::dmat4& world_from_voxel, int bits) {
  ShellSet set;
  set.volume.dims = dims;
  set.volume.world_from_voxel = world_from_voxel;
  set.grid = choose_grid(dims, world_from_voxel, {.bits = bits}).grid;
  return set;
}

/// How far a position lies beyond each plane, in voxels: 2 axis the low, 2 axis + 1 the high one.
std::array<double, 6> beyond_planes(const ShellSet& set, const glm::dvec3& p_mm) {
  const VoxelBox box = voxel_box(set.volume.dims);
  const glm::dvec3 p(voxel_from_local(set.volume.dims, set.volume.world_from_voxel) *
                     glm::dvec4(p_mm, 1.0));
  return {box.lo.x - p.x, p.x - box.hi.x, box.lo.y - p.y,
          p.y - box.hi.y, box.lo.z - p.z, p.z - box.hi.z};
}

/// Calls `visit(p_mm, planes)` with positions in faces, edges and corners of the box.
template <class Visit>
void on_the_border(const ShellSet& set, Visit&& visit) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const VoxelBox box = voxel_box(set.volume.dims);
  const glm::dmat4 local_from_voxel =
      glm::inverse(voxel_from_local(set.volume.dims, set.volume.world_from_voxel));
  for (int i = 0; i < 3000; ++i) {
    glm::dvec3 p;
    std::vector<std::size_t> planes;
    for (int axis = 0; axis < 3; ++axis) {
      const int where = (i / (axis == 0 ? 1 : axis == 1 ? 3 : 9)) % 3;  // low, high, between
      const double s = where == 2 ? 0.1 + 0.8 * unit(random) : where;
      p[axis] = box.lo[axis] + s * (box.hi[axis] - box.lo[axis]);
      if (where < 2) planes.push_back(static_cast<std::size_t>(2 * axis + where));
    }
    visit(glm::vec3(local_from_voxel * glm::dvec4(p, 1.0)), planes);
  }
}

TEST(BorderRounding, GoesOutwardsByAStepOrTwo) {
  for (const glm::dmat4& matrix : {glm::dmat4(1.0), aslant(), sheared()}) {
    for (const glm::i64vec3& dims : {glm::i64vec3(20, 30, 10), glm::i64vec3(8, 1, 5)}) {
      for (const int bits : {7, 10, 13}) {
        const ShellSet set = set_of(dims, matrix, bits);
        const BorderRounding border(set);
        const double step = step_mm(*set.grid);
        on_the_border(set, [&](const glm::dvec3& p, const std::vector<std::size_t>& planes) {
          ASSERT_EQ(border.is_on_border(p), !planes.empty());
          const glm::dvec3 rounded(grid_position(*set.grid, border.index(p)));
          if (planes.empty()) {
            ASSERT_EQ(border.index(p), nearest_index(*set.grid, p));
          }
          for (const std::size_t plane : planes) {
            ASSERT_GE(beyond_planes(set, rounded)[plane], -kOnPlane);
          }
          // A ball of this radius beyond a plane holds a point of the grid.
          const double faces_reach = std::sqrt(3.0) * step;
          ASSERT_LE(glm::distance(rounded, p), planes.size() < 2 ? faces_reach : 3.5 * step);
        });
      }
    }
  }
}

TEST(BorderRounding, LeavesWhatIsBeyondOnTheGridWhereItIs) {
  const ShellSet set = set_of({20, 30, 10}, aslant(), 9);
  const BorderRounding border(set);
  on_the_border(set, [&](const glm::dvec3& p, const std::vector<std::size_t>&) {
    const glm::ivec3 once = border.index(p);
    ASSERT_EQ(border.index(glm::dvec3(grid_position(*set.grid, once))), once);
  });
}

TEST(BorderRounding, NeedsAGridAndAVolume) {
  ShellSet set = set_of({2, 2, 2}, glm::dmat4(1.0), 8);
  set.grid.reset();
  EXPECT_THROW(BorderRounding{set}, Error);
  set.grid = QuantizationGrid{};
  set.volume = {};
  EXPECT_THROW(BorderRounding{set}, Error);
}

/// Bright throughout: its shells are nothing but caps.
Volume full(const glm::i64vec3& dims, const glm::dmat4& matrix) {
  Volume volume = testing::volume_of<float>(dims, [](auto, auto, auto) { return 1.0; });
  volume.world_from_voxel = matrix;
  return volume;
}

TEST(BorderRounding, ShellsCoverAFullVolume) {
  for (const glm::dmat4& matrix : {glm::dmat4(1.0), aslant(), sheared()}) {
    for (const glm::i64vec3& dims : {glm::i64vec3(9, 7, 5), glm::i64vec3(1, 1, 1)}) {
      for (const double tolerance : {0.0, 0.05}) {
        BuildOptions options;
        options.levels = explicit_levels(std::vector<double>{0.5});
        options.emission_tolerance = tolerance;
        options.quantization_bits = 8;
        const Volume volume = full(dims, matrix);
        const ShellSet set = build_shells(volume, EmissionMap::window(0, 1), options).set;
        const TriangleMesh& surface = set.shells[0].surface;
        EXPECT_TRUE(check_shell(surface).is_sound());
        const VoxelBox box = voxel_box(dims);
        const glm::dvec3 extent = box.hi - box.lo;
        const double box_mm3 =
            std::abs(glm::determinant(glm::dmat3(matrix))) * extent.x * extent.y * extent.z;
        EXPECT_GE(check_shell(surface).volume_mm3, box_mm3 * (1.0 - 1e-6));
        for (const glm::vec3& p : surface.positions) {
          const auto beyond = beyond_planes(set, p);
          EXPECT_GE(*std::ranges::max_element(beyond), -kOnPlane);
        }
      }
    }
  }
}

TEST(BorderRounding, PicturesOfAFullVolumeAreTheExactOnes) {
  BuildOptions options;
  options.levels = explicit_levels(std::vector<double>{0.5});
  options.quantization_bits = 7;
  for (const glm::dmat4& matrix : {aslant(), sheared()}) {
    const Volume volume = full({9, 7, 5}, matrix);
    const EmissionMap emission = EmissionMap::window(0, 1);
    const ExactWalk walk(volume, emission);
    for (const double tolerance : {0.0, 0.05}) {
      options.emission_tolerance = tolerance;
      const ShellSet set = build_shells(volume, emission, options).set;
      for (int view = 0; view < 12; ++view) {
        CameraOptions from{.size = {90, 80}, .azimuth_rad = 0.5 * view, .elevation_rad = 0.3};
        if (view % 2 == 1) from.field_of_view_rad = 0.6;
        const Camera camera = testing::camera_of(volume, from);
        const Image shown = shell_picture(set, camera).volume;
        const Image exact = exact_picture(walk, camera).volume;
        for (int y = 0; y < exact.height; ++y) {
          for (int x = 0; x < exact.width; ++x) {
            EXPECT_EQ(shown.at(x, y), exact.at(x, y))
                << x << ", " << y << " of view " << view << " at " << tolerance;
          }
        }
      }
      EXPECT_EQ(certify(set, volume, emission, {.size = {64, 64}}).max.max_error, 0.0);
    }
  }
}

}  // namespace
}  // namespace nacre
