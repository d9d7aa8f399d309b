#include "report/shell_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/volume_geometry.h"
#include "extract/levels.h"
#include "shells/build.h"
#include "tests/support/expect_error.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::expect_error;
using testing::volume_of;

#ifdef NDEBUG
constexpr int kSide = 64;
#else
constexpr int kSide = 24;
#endif

/// A few thin, crossing tubes with noise-like ripples: something of every cause.
Volume tubes() {
  Volume volume = volume_of<std::uint8_t>({32, 28, 24}, [](auto x, auto y, auto z) {
    const double a = std::hypot(0.4 * double(x) - 5.0, double(y) - 12.0 - 0.3 * double(x));
    const double b = std::hypot(double(x) - 16.0, double(z) - 11.0 - 0.2 * double(y));
    const double ripple = 8.0 * std::sin(1.7 * double(x) + 2.3 * double(y) * double(z));
    return std::clamp(230.0 * std::exp(-0.1 * a * a) + 200.0 * std::exp(-0.05 * b * b) + ripple,
                      0.0, 255.0);
  });
  volume.world_from_voxel = {{0.5, 0, 0, 0}, {0, 0.6, 0, 0}, {0, 0, 0.8, 0}, {-100, 40, 7, 1}};
  return volume;
}

const EmissionMap kMap = EmissionMap::window(20.0, 230.0);

ShellSet shells_of(const Volume& volume, std::size_t levels, double tolerance) {
  return build_shells(volume, kMap,
                      {.levels = uniform_levels(levels), .emission_tolerance = tolerance})
      .set;
}

Camera camera_of(const ShellSet& set) {
  return make_camera({.size = {kSide, kSide}, .azimuth_rad = 0.6, .elevation_rad = 0.2},
                     bounding_sphere(set.volume.dims, set.volume.world_from_voxel));
}

const ErrorStage& stage(const ShellErrorChain& chain, const std::string& cause) {
  for (const ErrorStage& found : chain.stages) {
    if (found.cause == cause) return found;
  }
  throw std::runtime_error("no stage " + cause);
}

TEST(ShellError, AnUnsimplifiedSetIsItsContoursSnapped) {
  const Volume volume = tubes();
  const ShellSet set = shells_of(volume, 8, 0.0);
  for (const PictureMode mode : {PictureMode::Max, PictureMode::Sum}) {
    const ShellErrorChain chain = shell_error_chain(tubes(), set, camera_of(set), {.mode = mode});
    ASSERT_EQ(chain.stages.size(), 4u);
    EXPECT_EQ(stage(chain, "simplification").picture.pixels,
              stage(chain, "vertex quantisation").picture.pixels);
    EXPECT_NE(stage(chain, "contouring").picture.pixels, stage(chain, "levels").picture.pixels);
    const ErrorSplit split = split_error(chain.truth, chain.stages);
    double shares = 0.0;
    for (const ErrorPart& part : split.parts) shares += part.share;
    EXPECT_NEAR(shares, 1.0, 1e-12);
    EXPECT_EQ(split.parts[3].rmse, 0.0);
  }
}

TEST(ShellError, LevelsAreOffByHalfALayerAtMostAndFadeWithTheirNumber) {
  const Volume volume = tubes();
  double before = 1.0;
  for (const std::size_t levels : {6, 24}) {
    const ShellSet set = shells_of(volume, levels, 0.0);
    const ShellErrorChain chain = shell_error_chain(tubes(), set, camera_of(set), {});
    const ErrorSplit split = split_error(chain.truth, chain.stages);
    EXPECT_LE(split.parts[0].max_error, 0.5 / static_cast<double>(levels) + 1e-6);
    EXPECT_LT(split.parts[0].rmse, 0.5 * before);
    before = split.parts[0].rmse;
  }
}

TEST(ShellError, SimplificationShowsInItsOwnStage) {
  const Volume volume = tubes();
  const ShellSet set = shells_of(volume, 3, 0.05);
  const ShellErrorChain chain = shell_error_chain(tubes(), set, camera_of(set), {});
  const ErrorSplit split = split_error(chain.truth, chain.stages);
  EXPECT_EQ(split.parts[3].cause, "simplification");
  EXPECT_GT(split.parts[3].rmse, 2.0 * split.parts[2].rmse);
}

TEST(ShellError, RefusesAnotherVolume) {
  const Volume volume = tubes();
  const ShellSet set = shells_of(volume, 3, 0.0);
  Volume other = tubes();
  samples_as<std::uint8_t>(other)[77] ^= 1U;
  expect_error(ErrorCode::BadArgument, "checksum",
               [&] { shell_error_chain(std::move(other), set, camera_of(set), {}); });
  Volume smaller = volume_of<std::uint8_t>({3, 3, 3}, [](auto, auto, auto) { return 1; });
  expect_error(ErrorCode::BadArgument, "3 x 3 x 3",
               [&] { shell_error_chain(std::move(smaller), set, camera_of(set), {}); });
}

TEST(ShellError, MapsThatFallAreTakenFromTheSet) {
  // The set holds the negated slope; the file, the volume as it was.
  const Volume volume = tubes();
  Volume negated = tubes();
  negated.slope = -volume.slope;
  negated.intercept = -volume.intercept;
  const EmissionMap map = EmissionMap::window(-230.0, -20.0);
  const ShellSet set = build_shells(negated, map, {.levels = uniform_levels(4)}).set;
  const ShellErrorChain from_file = shell_error_chain(tubes(), set, camera_of(set), {});
  const ShellErrorChain from_memory =
      shell_error_chain(std::move(negated), set, camera_of(set), {});
  EXPECT_EQ(from_file.truth.pixels, from_memory.truth.pixels);
}

}  // namespace
}  // namespace nacre
