#include "casting/sampled_maximum.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "casting/cast_bricks.h"
#include "casting/cast_rays.h"
#include "core/tool.h"
#include "reference/exact_picture.h"
#include "reference/walk_field.h"
#include "report/picture_error.h"
#include "tests/support/expect_error.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::camera_of;
using testing::expect_error;
using testing::instruction_sets;
using testing::random_volume;
using testing::volume_of;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kSide = 70;  // more than two tiles, and not whole ones
#ifdef NDEBUG
constexpr int kEach = 1;  // pixel is looked at
#else
constexpr int kEach = 3;
#endif

/// From outside and inside, along axes and askew, near and far.
std::vector<CameraOptions> cameras() {
  const glm::ivec2 size{kSide, kSide / 2};
  return {{.size = size},
          {.size = size, .view = NamedView::Superior, .zoom = 3.0},
          {.size = size, .view = NamedView::Left, .elevation_rad = 0.2},
          {.size = size, .azimuth_rad = 0.4, .elevation_rad = -0.3, .roll_rad = 0.1},
          {.size = size, .azimuth_rad = 2.0, .field_of_view_rad = 50 * kDegree},
          {.size = size, .field_of_view_rad = 0.05 * kDegree},
          {.size = size, .field_of_view_rad = 20 * kDegree, .distance_mm = 0.3},
          {.size = {1, 1}, .azimuth_rad = 0.7}};
}

/// A skew volume, bright in parts, so that bricks, tiles and rays without anything occur.
Volume skew_volume() {
  Volume volume = random_volume<std::uint8_t>({21, 17, 13}, 0, 90);
  volume.world_from_voxel[0] = {0.5, 0.1, 0.0, 0.0};
  volume.world_from_voxel[1] = {-0.1, 0.5, 0.1, 0.0};
  volume.world_from_voxel[2] = {0.0, -0.2, 1.0, 0.0};
  volume.world_from_voxel[3] = {-30.0, 50.0, 7.0, 1.0};
  return volume;
}

/// The trilinear field at a place, which is clamped to the volume.
double field_at(const Volume& volume, glm::dvec3 p) {
  const auto samples = samples_as<std::uint8_t>(volume);
  glm::ivec3 cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double last = static_cast<double>(volume.dims[axis] - 1);
    p[axis] = std::clamp(p[axis], 0.0, last);
    cell[axis] = static_cast<int>(std::min(std::floor(p[axis]), last - 1.0));
  }
  const glm::dvec3 s = p - glm::dvec3(cell);
  double value = 0.0;
  for (int i = 0; i < 8; ++i) {
    const glm::ivec3 corner(i & 1, i >> 1 & 1, i >> 2);
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) weight *= corner[axis] == 1 ? s[axis] : 1.0 - s[axis];
    const glm::i64vec3 at(cell + corner);
    value +=
        weight *
        samples[static_cast<std::size_t>(at.x + volume.dims.x * (at.y + volume.dims.y * at.z))];
  }
  return value;
}

struct Bounds {
  double least = 0.0;
  double most = 0.0;
};

/// What samples of a ray show, in double: without those that lie within a hair of where the ray is
/// cut off or of the volume's border, and with them.
Bounds sampled_along(const Volume& volume, const WalkField& field, const Ray& ray,
                     const RayInterval& interval, int axis, int per_cell, const EmissionMap& map,
                     const CueField& cue) {
  constexpr double kHair = 1e-3;
  const CellLine line = field.frame.line(ray);
  Bounds seen;
  const auto look = [&](double t, double margin, int across) {
    if (!std::isfinite(t)) return;
    const glm::dvec3 p = line.origin + t * line.direction;
    const glm::dvec3 world = ray.origin_mm + t * ray.direction;
    double inside = margin;
    for (int other = 0; other < 3; ++other) {
      if (other == across) continue;
      inside = std::min({inside, p[other], static_cast<double>(field.cells[other]) - p[other]});
    }
    const double beta =
        std::max(0.0, cue.at_center + glm::dot(cue.rise_per_mm, world - cue.center_mm));
    const double shown = beta * map(field_at(volume, p));
    if (inside > kHair) seen.least = std::max(seen.least, shown);
    if (inside > -kHair) seen.most = std::max(seen.most, shown);
  };
  const auto look_on_plane = [&](int across, double plane) {
    const double t = (plane - line.origin[across]) / line.direction[across];
    look(t, std::min(t - interval.t_begin_mm, interval.t_end_mm - t), across);
  };
  const int planes = static_cast<int>(field.cells[axis]) * per_cell;
  for (int j = 0; j <= planes; ++j) look_on_plane(axis, static_cast<double>(j) / per_cell);
  for (int other = 0; other < 3; ++other) {
    if (other == axis) continue;
    look_on_plane(other, 0.0);
    look_on_plane(other, static_cast<double>(field.cells[other]));
  }
  const double length = interval.t_end_mm - interval.t_begin_mm;
  look(interval.t_begin_mm, length, -1);
  look(interval.t_end_mm, length, -1);
  return seen;
}

/// Steps of floats at positions of some tens of cells, times slopes of random samples.
constexpr double kTiny = 3e-4;

/// Of a pixel's tile.
std::optional<CastAxes> axes_at(const WalkField& field, const Camera& camera,
                                const glm::ivec2& pixel) {
  const glm::ivec2 tile = BlockRays::kTile * (pixel / BlockRays::kTile);
  return steep_axes(field, camera, {tile, glm::min(tile + BlockRays::kTile, camera.size) - 1});
}

void expect_samples(const Volume& volume, const EmissionMap& map, const CameraOptions& options,
                    int per_cell, const DepthCue& cue, const Slab& slab,
                    const ToolRays* tools = nullptr) {
  const ExactWalk walk(volume, map);
  const Camera camera = camera_of(volume, options);
  const SampledMaximum maximum(walk);
  const Image image =
      maximum.picture(camera, {.per_cell = per_cell, .cue = cue, .slab = slab, .tools = tools})
          .volume;
  for (int y = 0; y < camera.size.y; y += kEach) {
    for (int x = 0; x < camera.size.x; x += kEach) {
      const auto axes = axes_at(walk.field(), camera, {x, y});
      ASSERT_TRUE(axes);
      const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
      RayInterval interval = visible_interval(camera, ray, slab);
      if (tools != nullptr) {
        const auto hit = tools->nearest(ray, visible_interval(camera, ray, {}));
        if (hit) interval.t_end_mm = std::min(interval.t_end_mm, hit->t_mm);
      }
      const Bounds expected = sampled_along(volume, walk.field(), ray, interval, axes->plane,
                                            per_cell, map, cue_field(cue, camera));
      ASSERT_GE(image.at(x, y), expected.least - kTiny) << x << ' ' << y;
      ASSERT_LE(image.at(x, y), expected.most + kTiny) << x << ' ' << y;
    }
  }
}

TEST(SampledMaximum, IsTheGreatestOfItsSamplesFromAllSides) {
  const Volume volume = skew_volume();
  for (const EmissionMap& map :
       {EmissionMap::window(80.0, 89.0), EmissionMap::window(20.0, 70.0)}) {
    for (const CameraOptions& camera : cameras()) {
      for (const int per_cell : {1, 2, 5}) {
        for (const DepthCue& cue :
             {DepthCue{}, DepthCue{0.8, 0.2, 0.0}, DepthCue{-1.5, 1.5, 0.0}}) {
          expect_samples(volume, map, camera, per_cell, cue, {});
        }
      }
    }
  }
}

TEST(SampledMaximum, ShowsWhatASlabLeaves) {
  const Volume volume = skew_volume();
  for (const CameraOptions& camera : cameras()) {
    for (const Slab& slab : {Slab{-3.0, 2.0}, Slab{1.0, 1.25}, Slab{100.0, 200.0}}) {
      expect_samples(volume, EmissionMap::window(60.0, 90.0), camera, 3, {}, slab);
      expect_samples(volume, EmissionMap::window(60.0, 90.0), camera, 3, {0.5, 0.5, 0.0}, slab);
    }
  }
}

TEST(SampledMaximum, StopsAtTools) {
  const Volume volume = random_volume<std::uint8_t>({16, 16, 16}, 0, 255);
  Tool tool;
  tool.mesh.positions = {{4, 4, 4}, {12, 4, 4}, {4, 12, 4}, {4, 4, 12}};
  tool.mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  const ToolRays tools(std::span(&tool, 1));
  const EmissionMap map = EmissionMap::window(100.0, 255.0);
  const ExactWalk walk(volume, map);
  const SampledMaximum maximum(walk);
  for (const CameraOptions& options : cameras()) {
    expect_samples(volume, map, options, 2, {}, {}, &tools);
    const Camera camera = camera_of(volume, options);
    const Picture picture = maximum.picture(camera, {.tools = &tools});
    const Picture exact = exact_picture(walk, camera, {.tools = &tools});
    ASSERT_EQ(picture.tools.has_value(), exact.tools.has_value());
    if (!exact.tools) continue;
    EXPECT_EQ(picture.tools->covered, exact.tools->covered);
    EXPECT_EQ(picture.tools->colors, exact.tools->colors);
  }
}

double rms_difference(const Image& picture, const Image& truth) {
  return compare_pictures(picture, truth, 1.0).all.rmse;
}

TEST(SampledMaximum, NeverExceedsTheExactAndNearsIt) {
  // Smooth, so that maxima lie within cells.
  const Volume volume = volume_of<float>({24, 24, 24}, [](auto x, auto y, auto z) {
    const glm::dvec3 p(x, y, z);
    return std::exp(-0.02 * glm::dot(p - 11.3, p - 11.3)) + 0.1 * std::sin(p.x + 0.7 * p.y - p.z);
  });
  const ExactWalk walk(volume, EmissionMap::window(0.0, 1.2));
  const SampledMaximum maximum(walk);
  for (const DepthCue& cue : {DepthCue{}, DepthCue{0.6, 0.4, 0.0}}) {
    for (const CameraOptions& options :
         {CameraOptions{.size = {64, 64}, .azimuth_rad = 0.4, .elevation_rad = 0.3},
          CameraOptions{.size = {64, 64}, .field_of_view_rad = 40 * kDegree}}) {
      const Camera camera = camera_of(volume, options);
      const Image exact = exact_picture(walk, camera, {.cue = cue}).volume;
      std::vector<double> errors;
      for (const int per_cell : {2, 4, 8, 16}) {
        const Image image = maximum.picture(camera, {.per_cell = per_cell, .cue = cue}).volume;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
          ASSERT_LE(image.pixels[i], exact.pixels[i] + 2e-5F);
        }
        errors.push_back(rms_difference(image, exact));
      }
      EXPECT_LT(errors[0], 0.01);
      // Four times as many: at least a third of the error. Where it falls to a kink of the field,
      // it is the distance's.
      EXPECT_GT(errors[0] / errors[2], 3.0);
      EXPECT_GT(errors[1] / errors[3], 3.0);
    }
  }
}

TEST(SampledMaximum, IsTheSameForAllThreadsAndInstructions) {
  const Volume volume = skew_volume();
  for (const EmissionMap& map : {EmissionMap::window(40.0, 89.0),
                                 EmissionMap::piecewise_linear({{60.0, 0.2}, {85.0, 0.9}})}) {
    const ExactWalk walk(volume, map);
    const SampledMaximum maximum(walk);
    for (const CameraOptions& options : cameras()) {
      const Camera camera = camera_of(volume, options);
      for (const DepthCue& cue : {DepthCue{}, DepthCue{0.6, 0.4, 0.0}, DepthCue{-1.5, 1.5, 0.0}}) {
        const auto draw = [&](InstructionSet set) {
          return maximum.picture(camera, {.per_cell = 3, .cue = cue, .instructions = set})
              .volume.pixels;
        };
        const auto first = draw(InstructionSet::Baseline);
        for (const InstructionSet set : instruction_sets()) EXPECT_EQ(draw(set), first);
        const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
        EXPECT_EQ(draw(best_instruction_set()), first);
      }
    }
  }
}

/// Rays meet bright samples wherever they go: what is drawn is near the exact.
void expect_near_exact(const Volume& volume, const EmissionMap& map, const CameraOptions& options,
                       const DepthCue& cue) {
  const ExactWalk walk(volume, map);
  const Camera camera = camera_of(volume, options);
  const Image exact = exact_picture(walk, camera, {.cue = cue}).volume;
  const Image image =
      SampledMaximum(walk).picture(camera, {.per_cell = kMostSamplesPerCell, .cue = cue}).volume;
  EXPECT_LT(rms_difference(image, exact), 0.04);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    ASSERT_TRUE(std::isfinite(image.pixels[i]));
    ASSERT_LE(image.pixels[i], exact.pixels[i] + 1e-4F);
  }
}

TEST(SampledMaximum, FollowsMapsOfManyKnotsAndFallingSlopes) {
  Volume volume = random_volume<std::int16_t>({14, 9, 10}, -2000, 2000);
  volume.slope = -0.25;
  volume.intercept = 100.0;
  const EmissionMap many = EmissionMap::piecewise_linear(
      {{-300.0, 0.2}, {0.0, 0.25}, {1.0, 0.7}, {500.0, 0.7}, {580.0, 1.0}});
  const EmissionMap bright = EmissionMap::piecewise_linear({{-300.0, 0.3}, {580.0, 0.9}});
  for (const CameraOptions& camera : cameras()) {
    expect_near_exact(volume, many, camera, {});
    expect_near_exact(volume, bright, camera, {});
    expect_near_exact(volume, bright, camera, {0.7, 0.3, 0.0});
    expect_near_exact(volume, bright, camera, {0.0, 0.5, 0.0});
  }
}

TEST(SampledMaximum, HoldsThinVolumesAndSpacingsOf1000) {
  for (const glm::i64vec3& dims :
       {glm::i64vec3{1, 1, 1}, {1, 9, 9}, {9, 1, 9}, {9, 9, 1}, {2, 1, 5}, {5, 6, 4}}) {
    Volume volume = random_volume<float>(dims, 0.5, 1.0);
    for (const double spacing : {1.0, 1000.0}) {
      volume.world_from_voxel[2] *= spacing;
      for (const CameraOptions& camera : cameras()) {
        expect_near_exact(volume, EmissionMap::window(0.0, 1.0), camera, {});
        expect_near_exact(volume, EmissionMap::window(0.0, 1.0), camera, {1.0, 0.0, 0.0});
      }
    }
  }
}

TEST(SampledMaximum, HoldsExtremeSamplesAndWindows) {
  const auto pattern = [](auto x, auto y, auto z) {
    return 0.1 + 0.03 * static_cast<double>((x * 7 + y * 5 + z * 3) % 29);
  };
  struct Case {
    double scale;
    double offset;
    EmissionMap map;
  };
  for (const auto& [scale, offset, map] :
       {Case{1e-300, 0.0, EmissionMap::window(5e-301, 9e-301)},
        Case{1e300, 0.0, EmissionMap::window(5e299, 9e299)},
        Case{1.0, 1e9, EmissionMap::window(1e9 + 0.5, 1e9 + 0.9)},
        Case{1e308, 0.0, EmissionMap::window(-1.5e308, 1.5e308)},   // width overflows: exact
        Case{1e-310, 0.0, EmissionMap::window(5e-311, 9e-311)}}) {  // 1 / width does: exact
    const Volume volume = volume_of<double>(
        {9, 9, 9}, [&](auto x, auto y, auto z) { return offset + scale * pattern(x, y, z); });
    for (const CameraOptions& camera : cameras()) {
      expect_near_exact(volume, map, camera, {});
      expect_near_exact(volume, map, camera, {0.7, 0.3, 0.0});
    }
  }
}

TEST(SampledMaximum, IsExactWhereRaysOfATileSpreadTooFar) {
  const Volume volume = skew_volume();
  const ExactWalk walk(volume, EmissionMap::window(40.0, 90.0));
  const Camera camera = camera_of(volume, {.size = {20, 20},
                                           .azimuth_rad = 0.8,
                                           .field_of_view_rad = 120 * kDegree,
                                           .distance_mm = 0.3});
  EXPECT_FALSE(steep_axes(walk.field(), camera, {{0, 0}, {19, 19}}));
  const SampledMaximum maximum(walk);
  EXPECT_FALSE(maximum.takes_samples(camera));
  EXPECT_EQ(maximum.picture(camera).volume.pixels, exact_picture(walk, camera).volume.pixels);
}

TEST(SampledMaximum, IsExactWhereFloatsDoNotResolveWhatIsSeen) {
  const Volume volume = random_volume<float>({9, 9, 9}, -1000.0, 3000.0);
  const Camera camera = camera_of(volume, {.size = {40, 40}, .azimuth_rad = 0.4});
  for (const EmissionMap& map :
       {EmissionMap::window(0.0, 1e-35), EmissionMap::window(0.0, 1e-3),
        EmissionMap::piecewise_linear({{-1e9, 0.0}, {100.0, 0.0}, {101.0, 1.0}}),
        EmissionMap::piecewise_linear({{-1e20, 0.0}, {0.0, 0.1}, {100.0, 0.5}, {1e20, 1.0}})}) {
    const ExactWalk walk(volume, map);
    const SampledMaximum maximum(walk);
    EXPECT_FALSE(maximum.takes_samples(camera));
    EXPECT_EQ(maximum.picture(camera).volume.pixels, exact_picture(walk, camera).volume.pixels);
  }
  const ExactWalk walk(volume, EmissionMap::window(0.0, 3000.0));
  const SampledMaximum maximum(walk);
  EXPECT_TRUE(maximum.takes_samples(camera));
  const DepthCue beyond{1e39, 0.0, 1.0};
  EXPECT_FALSE(maximum.takes_samples(camera, beyond));
  EXPECT_EQ(maximum.picture(camera, {.cue = beyond}).volume.pixels,
            exact_picture(walk, camera, {.cue = beyond}).volume.pixels);
}

TEST(SampledMaximum, RoundingStaysBelowWhatIsSaid) {
  // The narrowest window that samples are taken for.
  const Volume volume = random_volume<std::uint8_t>({200, 9, 9}, 0, 255);
  const ExactWalk walk(volume, EmissionMap::window(250.0, 255.0));
  const SampledMaximum maximum(walk);
  for (const CameraOptions& options : cameras()) {
    const Camera camera = camera_of(volume, options);
    ASSERT_TRUE(maximum.takes_samples(camera));
    const Image exact = exact_picture(walk, camera).volume;
    const Image image = maximum.picture(camera, {.per_cell = 4}).volume;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      ASSERT_LE(image.pixels[i], exact.pixels[i] + 0.01F);
    }
  }
}

TEST(SampledMaximum, RefusesWhatItDoesNotDraw) {
  const Volume volume = skew_volume();
  const ExactWalk walk(volume, EmissionMap::piecewise_linear({{1, 0.0}, {2, 0.5}, {3, 0.6}}));
  const SampledMaximum maximum(walk);
  const Camera camera = camera_of(volume, {.size = {8, 8}});
  for (const int per_cell : {0, -1, kMostSamplesPerCell + 1}) {
    expect_error(ErrorCode::BadArgument, "expected 1 to 16",
                 [&] { maximum.picture(camera, {.per_cell = per_cell}); });
  }
  expect_error(ErrorCode::Unsupported, "2 pieces", [&] {
    maximum.picture(camera, {.cue = {0.5, 0.5, 0.0}});
  });
  expect_error(ErrorCode::BadArgument, "slab", [&] {
    maximum.picture(camera, {.slab = {2.0, 1.0}});
  });
}

TEST(CastBricks, AreTheSameWhetherTheyAreKeptOrNot) {
  const Volume volume = skew_volume();
  const ExactWalk walk(volume, EmissionMap::window(20.0, 90.0));
  const CastScale scale{20.0, 1.0 / 70.0};
  const CastBricks kept(walk.field(), walk.bright_bricks(), scale);
  const CastBricks read(walk.field(), walk.bright_bricks(), scale, 0);
  BrickValues room;
  ASSERT_GT(walk.bright_bricks().bricks.size(), 10U);
  for (std::size_t i = 0; i < walk.bright_bricks().bricks.size(); ++i) {
    const float* a = kept.samples(i, room);
    EXPECT_NE(a, room.data());
    const float* b = read.samples(i, room);
    EXPECT_EQ(b, room.data());
    EXPECT_TRUE(std::equal(a, a + CastBrick::kAll, b));
  }
}

}  // namespace
}  // namespace nacre
