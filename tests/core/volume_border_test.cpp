#include "core/volume_border.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

namespace nacre {
namespace {

VolumeFacts oblique() {
  VolumeFacts volume;
  volume.dims = {5, 7, 1};
  volume.world_from_voxel =
      glm::rotate(glm::translate(glm::dmat4(1.0), {500.0, -20.0, 3.0}), 0.3, glm::dvec3(1, 2, 3)) *
      glm::scale(glm::dmat4(1.0), {0.5, 1.0, 2.0});
  return volume;
}

/// A voxel position in the frame of surfaces about a point.
glm::vec3 local(const VolumeFacts& volume, const glm::dvec3& voxel, const glm::dvec3& center_mm) {
  return glm::vec3(glm::dvec3(volume.world_from_voxel * glm::dvec4(voxel, 1.0)) - center_mm);
}

TEST(VolumeBorder, PutsWhatIsBeyondOnTheBorder) {
  const VolumeFacts volume = oblique();
  const glm::dvec3 box_center = bounding_sphere(volume.dims, volume.world_from_voxel).center_mm;
  for (const glm::dvec3& center : {box_center, box_center + glm::dvec3(3.0, -2.0, 1.0)}) {
    const VolumeBorder border(volume, center);
    const auto expect_moved = [&](const glm::dvec3& from, const glm::dvec3& to) {
      const glm::vec3 moved = border(local(volume, from, center));
      EXPECT_LT(glm::distance(moved, local(volume, to, center)), 1e-5F);
    };
    expect_moved({-0.1, 3.0, 0.2}, {0.0, 3.0, 0.2});
    expect_moved({4.2, 6.1, 0.2}, {4.0, 6.0, 0.2});
    expect_moved({4.2, -0.1, 0.7}, {4.0, 0.0, 0.5});
    expect_moved({1.0, 2.0, -9.0}, {1.0, 2.0, -0.5});
    const glm::vec3 within = local(volume, {1.3, 2.1, -0.4}, center);
    EXPECT_EQ(border(within), within);
  }
}

TEST(VolumeBorder, LeavesSurfacesWithinAlone) {
  ShellSet set;
  TriangleMesh mesh{{{0, 0, 0}, {100, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  EXPECT_FALSE(within_border(set, mesh)) << "no volume is stated";
  set.volume.dims = {11, 11, 11};
  set.center_mm = {5.0, 5.0, 5.0};
  const auto within = within_border(set, mesh);
  ASSERT_TRUE(within);
  EXPECT_EQ(within->triangles, mesh.triangles);
  EXPECT_EQ(within->positions, (std::vector<glm::vec3>{{0, 0, 0}, {5, 0, 0}, {0, 1, 0}}));
  EXPECT_FALSE(within_border(set, *within));
  set.volume.world_from_voxel[2] = {};
  EXPECT_FALSE(within_border(set, mesh)) << "a singular matrix has no box";
}

}  // namespace
}  // namespace nacre
