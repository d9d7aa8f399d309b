#include "peers/vtk_maximum.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "core/error.h"
#include "core/volume_geometry.h"
#include "datasets/phantom.h"
#include "reference/exact_picture.h"
#include "reference/exact_walk.h"
#include "report/picture_error.h"
#include "tests/support/expect_error.h"

namespace nacre {
namespace {

/// A volume that lies askew, whose spacings differ, seen from anywhere.
class VtkMaximumTest : public ::testing::Test {
 protected:
  VtkMaximumTest() {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), 0.4, glm::dvec3(1.0, 2.0, 3.0));
    volume_.world_from_voxel = glm::translate(glm::dmat4(1.0), glm::dvec3(100.0, -50.0, 30.0)) *
                               turn *
                               glm::scale(volume_.world_from_voxel, glm::dvec3(1.0, 1.3, 0.8));
    volume_.slope = 2.0;
    volume_.intercept = -5.0;
  }

  Camera camera(const CameraOptions& options) const {
    return make_camera(options, bounding_sphere(volume_.dims, volume_.world_from_voxel));
  }

  /// Root mean square over all pixels, of VTK's picture against the exact one.
  double error(const CameraOptions& options, const VtkSampling& sampling) const {
    VtkMaximum vtk(volume_, emission_, options.size);
    const Image picture = vtk.draw(camera(options), sampling);
    const ExactWalk walk(volume_, emission_);
    return compare_pictures(picture, exact_picture(walk, camera(options)).volume, 1.0).all.rmse;
  }

  Volume volume_ = make_phantom("spheres", {.size = glm::i64vec3(20, 18, 16)});
  const EmissionMap emission_ = EmissionMap::window(-5.0, 51.0);
  const CameraOptions side_{.size = {60, 40}, .azimuth_rad = 0.5, .elevation_rad = 0.3};
  const CameraOptions near_{.size = {40, 60}, .field_of_view_rad = 0.7};
};

// A shift by 0.2 mm along each axis gives 0.0026 already.
constexpr double kSameScene = 0.0006;

TEST_F(VtkMaximumTest, FixedPointShowsTheSameScene) {
  for (const CameraOptions& options : {side_, near_}) {
    EXPECT_LT(error(options, {VtkCaster::FixedPoint, 0.1}), kSameScene);
  }
}

TEST_F(VtkMaximumTest, GpuShowsTheSameScene) {
  for (const CameraOptions& options : {side_, near_}) {
    try {
      EXPECT_LT(error(options, {VtkCaster::Gpu, 0.1}), kSameScene);
    } catch (const Error& refusal) {
      GTEST_SKIP() << refusal.what();
    }
  }
}

TEST_F(VtkMaximumTest, SamplesFartherApartMissMore) {
  EXPECT_GT(error(side_, {VtkCaster::FixedPoint, 2.0}),
            1.5 * error(side_, {VtkCaster::FixedPoint, 0.25}));
}

TEST_F(VtkMaximumTest, RefusesWhatItWouldGetWrong) {
  VtkMaximum vtk(volume_, emission_, {8, 8});
  testing::expect_error(ErrorCode::BadArgument, "sample distance: found -1", [&] {
    vtk.draw(camera({.size = {8, 8}}), {VtkCaster::FixedPoint, -1.0});
  });
  volume_.slope = -1.0;
  testing::expect_error(ErrorCode::Unsupported, "slope -1", [&] {
    VtkMaximum(volume_, emission_, {8, 8});
  });
}

}  // namespace
}  // namespace nacre
