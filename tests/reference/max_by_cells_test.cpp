#include "reference/max_by_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "core/tool.h"
#include "reference/brick_samples.h"
#include "reference/cell_rectangles.h"
#include "reference/exact_picture.h"
#include "reference/exact_walk.h"
#include "reference/tile_lists.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::camera_of;
using testing::instruction_sets;
using testing::random_volume;
using testing::volume_of;

#ifdef NDEBUG
constexpr int kSide = 70;  // more than two tiles, and not whole ones
#else
constexpr int kSide = 33;
#endif

constexpr double kDegree = std::numbers::pi / 180.0;

/// From outside and inside, along axes and askew, near and far.
std::vector<CameraOptions> cameras() {
  const glm::ivec2 size{kSide, kSide / 2};
  return {{.size = size},
          {.size = size, .view = NamedView::Superior, .zoom = 3.0},
          {.size = size, .azimuth_rad = 0.4, .elevation_rad = -0.3, .roll_rad = 0.1},
          {.size = size, .azimuth_rad = 1e-11},
          {.size = size, .azimuth_rad = 2.0, .field_of_view_rad = 50 * kDegree},
          {.size = size, .field_of_view_rad = 0.05 * kDegree},
          {.size = size, .field_of_view_rad = 120 * kDegree, .distance_mm = 0.3},
          {.size = {1, 1}, .azimuth_rad = 0.7}};
}

struct Difference {
  double most = 0.0;
  int lit = 0;
};

/// Of a picture by cells and the walk's answer for each pixel's ray.
Difference against_the_walk(const Volume& volume, const EmissionMap& map,
                            const CameraOptions& camera_options, const DepthCue& cue,
                            const Slab& slab = {}) {
  const ExactWalk walk(volume, map);
  const Camera camera = camera_of(volume, camera_options);
  const Image image = exact_picture(walk, camera, {.cue = cue, .slab = slab}).volume;
  Difference difference;
  for (int y = 0; y < camera.size.y; ++y) {
    for (int x = 0; x < camera.size.x; ++x) {
      const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
      const double expected =
          walk.max_emission(ray, visible_interval(camera, ray, slab), cue_field(cue, camera));
      difference.most =
          std::max(difference.most,
                   std::abs(image.at(x, y) - static_cast<double>(static_cast<float>(expected))));
      difference.lit += expected > 0.0 ? 1 : 0;
    }
  }
  return difference;
}

constexpr double kUlp = 1.2e-7;  // of the picture's floats

TEST(MaxByCells, IsTheWalksMaximumFromAllSides) {
  // Part of it bright, so that bricks, tiles and rays without anything occur.
  Volume volume = random_volume<std::uint8_t>({21, 17, 13}, 0, 90);
  volume.world_from_voxel[0] = {0.5, 0.1, 0.0, 0.0};
  volume.world_from_voxel[1] = {-0.1, 0.5, 0.1, 0.0};
  volume.world_from_voxel[2] = {0.0, -0.2, 1.0, 0.0};
  volume.world_from_voxel[3] = {-30.0, 50.0, 7.0, 1.0};
  for (const EmissionMap& map :
       {EmissionMap::window(80.0, 89.0), EmissionMap::window(-5.0, 70.0),
        EmissionMap::piecewise_linear({{70.0, 0.2}, {85.0, 0.9}}),
        EmissionMap::piecewise_linear({{60.0, 0.1}, {80.0, 0.2}, {81.0, 0.7}, {90.0, 0.8}})}) {
    int lit = 0;
    for (const CameraOptions& camera : cameras()) {
      for (const DepthCue& cue : {DepthCue{}, DepthCue{0.8, 0.2, 0.0}, DepthCue{-1.5, 1.5, 0.0}}) {
        const Difference difference = against_the_walk(volume, map, camera, cue);
        EXPECT_LE(difference.most, kUlp);
        lit += difference.lit;
      }
    }
    EXPECT_GT(lit, 500);
  }
}

TEST(MaxByCells, ShowsWhatASlabLeaves) {
  const Volume volume = random_volume<float>({9, 20, 11}, 0.0, 1.0);
  for (const CameraOptions& camera : cameras()) {
    for (const Slab& slab : {Slab{-3.0, 2.0}, Slab{1.0, 1.25}, Slab{100.0, 200.0}}) {
      const auto difference = against_the_walk(volume, EmissionMap::window(0.9, 1.0), camera,
                                               DepthCue{0.5, 0.5, 0.0}, slab);
      EXPECT_LE(difference.most, kUlp);
      EXPECT_LE(against_the_walk(volume, EmissionMap::window(0.9, 1.0), camera, {}, slab).most,
                kUlp);
    }
  }
}

TEST(MaxByCells, FollowsMapsOfManyKnotsAndFallingSlopes) {
  Volume volume = random_volume<std::int16_t>({14, 9, 10}, -2000, 2000);
  volume.slope = -0.25;
  volume.intercept = 100.0;
  const EmissionMap map = EmissionMap::piecewise_linear(
      {{-300.0, 0.2}, {0.0, 0.25}, {1.0, 0.7}, {500.0, 0.7}, {580.0, 1.0}});
  for (const CameraOptions& camera : cameras()) {
    EXPECT_LE(against_the_walk(volume, map, camera, {}).most, kUlp);
    EXPECT_LE(against_the_walk(volume, map, camera, {0.9, 0.1, 0.0}).most, kUlp);
    EXPECT_LE(against_the_walk(volume, map, camera, {-1.0, 1.0, 0.0}).most, kUlp);
  }
}

TEST(MaxByCells, TakesThinVolumesAndSteepSpacings) {
  for (const glm::i64vec3& dims : {glm::i64vec3{1, 1, 1}, glm::i64vec3{1, 7, 1},
                                   glm::i64vec3{6, 1, 9}, glm::i64vec3{2, 2, 2}}) {
    Volume volume = random_volume<float>(dims, 0.5, 1.0);
    volume.world_from_voxel[2] *= 1000.0;
    for (const CameraOptions& camera : cameras()) {
      for (const DepthCue& cue : {DepthCue{}, DepthCue{1.0, 0.0, 0.0}}) {
        EXPECT_LE(against_the_walk(volume, EmissionMap::window(0.0, 1.0), camera, cue).most, kUlp);
      }
    }
  }
}

TEST(MaxByCells, HoldsExtremeSamples) {
  for (const double scale : {1e-38, 1.0, 1e38}) {
    const Volume volume = volume_of<float>({9, 9, 9}, [&](auto x, auto y, auto z) {
      return scale * (0.1 + 0.03 * static_cast<double>((x * 7 + y * 5 + z * 3) % 29));
    });
    const EmissionMap map = EmissionMap::window(0.5 * scale, 0.9 * scale);
    for (const CameraOptions& camera : cameras()) {
      EXPECT_LE(against_the_walk(volume, map, camera, {}).most, kUlp);
      EXPECT_LE(against_the_walk(volume, map, camera, {0.7, 0.3, 0.0}).most, kUlp);
    }
  }
}

TEST(MaxByCells, HoldsWindowsWhoseWidthOrSlopeOverflows) {
  const auto pattern = [](auto x, auto y, auto z) {
    return 0.1 + 0.03 * static_cast<double>((x * 7 + y * 5 + z * 3) % 29);
  };
  struct Case {
    double scale;
    EmissionMap map;
  };
  for (const auto& [scale, map] : {Case{1e308, EmissionMap::window(-1.5e308, 1.5e308)},
                                   Case{1e-310, EmissionMap::window(5e-311, 9e-311)}}) {
    const Volume volume = volume_of<double>(
        {9, 9, 9}, [&](auto x, auto y, auto z) { return scale * pattern(x, y, z); });
    for (const CameraOptions& camera : cameras()) {
      const Difference difference = against_the_walk(volume, map, camera, {0.7, 0.3, 0.0});
      EXPECT_LE(difference.most, kUlp);
    }
  }
}

TEST(MaxByCells, StopsAtTools) {
  // A cube within the volume: of its pixels only what lies in front is shown.
  const Volume volume = random_volume<std::uint8_t>({16, 16, 16}, 0, 255);
  Tool tool;
  tool.mesh.positions = {{4, 4, 4}, {12, 4, 4}, {4, 12, 4}, {4, 4, 12}};
  tool.mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  const ToolRays tools(std::span(&tool, 1));
  const ExactWalk walk(volume, EmissionMap::window(100.0, 255.0));
  for (const CameraOptions& options : cameras()) {
    const Camera camera = camera_of(volume, options);
    const Picture picture = exact_picture(walk, camera, {.tools = &tools});
    for (int y = 0; y < camera.size.y; ++y) {
      for (int x = 0; x < camera.size.x; ++x) {
        const Ray ray = picture_ray(camera, x + 0.5, y + 0.5);
        RayInterval interval = visible_interval(camera, ray, {});
        const auto hit = tools.nearest(ray, interval);
        if (hit) interval.t_end_mm = hit->t_mm;
        EXPECT_NEAR(picture.volume.at(x, y), walk.max_emission(ray, interval), kUlp);
        EXPECT_EQ(
            hit.has_value(),
            picture.tools && picture.tools->covered.at(static_cast<std::size_t>(y) *
                                                           static_cast<std::size_t>(camera.size.x) +
                                                       static_cast<std::size_t>(x)) != 0);
      }
    }
  }
}

TEST(MaxByCells, EveryInstructionSetGivesTheSameBits) {
  if (best_instruction_set() == InstructionSet::Baseline) {
    GTEST_SKIP() << "this processor has the baseline's instructions only";
  }
  const Volume volume = random_volume<float>({20, 15, 18}, 0.0, 1.0);
  for (const EmissionMap& map :
       {EmissionMap::window(0.3, 1.0), EmissionMap::piecewise_linear({{0.3, 0.2}, {0.8, 0.9}}),
        EmissionMap::piecewise_linear({{0.3, 0.0}, {0.5, 0.1}, {0.6, 0.8}, {1.0, 1.0}})}) {
    const ExactWalk walk(volume, map);
    for (const CameraOptions& options : cameras()) {
      const Camera camera = camera_of(volume, options);
      for (const DepthCue& cue : {DepthCue{}, DepthCue{0.6, 0.4, 0.0}, DepthCue{-1.5, 1.5, 0.0}}) {
        std::vector<std::vector<float>> pixels;
        for (const InstructionSet set : instruction_sets()) {
          const MaxByCells scene{&walk.field(), &walk.bright_bricks(), &walk.cued_emission(),
                                 cell_kernel_for(set)};
          pixels.push_back(max_picture_by_cells(scene, camera, cue, {}, nullptr, {}).volume.pixels);
        }
        for (const auto& others : pixels) EXPECT_EQ(others, pixels[0]);
      }
    }
  }
}

TEST(BrightBricks, HoldEveryCellAboveTheFirstKnotTheBrightestFirst) {
  const Volume volume = random_volume<std::int16_t>({19, 9, 14}, -500, 500);
  constexpr double kFloor = 480.0;
  const ExactWalk walk(volume, EmissionMap::window(kFloor, 600.0));
  const auto& bricks = walk.bright_bricks().bricks;
  const auto samples = samples_as<std::int16_t>(volume);
  std::size_t bright = 0;
  for (int z = 0; z < 13; ++z) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 18; ++x) {
        double greatest = -1e9;
        for (int i = 0; i < 8; ++i) {
          const int at = (x + (i & 1)) + 19 * ((y + (i >> 1 & 1)) + 9 * (z + (i >> 2)));
          greatest = std::max<double>(greatest, samples[static_cast<std::size_t>(at)]);
        }
        if (greatest <= kFloor) continue;
        ++bright;
        const glm::ivec3 first = BrightBricks::kSide * (glm::ivec3(x, y, z) / BrightBricks::kSide);
        const auto found = std::find_if(bricks.begin(), bricks.end(),
                                        [&](const auto& b) { return b.first_cell == first; });
        ASSERT_NE(found, bricks.end());
        EXPECT_GE(found->greatest, greatest);
      }
    }
  }
  EXPECT_GT(bright, 50U);
  EXPECT_TRUE(std::is_sorted(bricks.begin(), bricks.end(),
                             [](const auto& a, const auto& b) { return a.greatest > b.greatest; }));
}

TEST(CellsWithin, AreThoseOfTheVolume) {
  for (const glm::ivec3& cells : {glm::ivec3{4, 4, 4}, {1, 1, 1}, {3, 7, 2}, {4, 1, 9}}) {
    const unsigned long long bits = cells_within(cells);
    for (int i = 0; i < 64; ++i) {
      const bool within = i % 4 < cells.x && i / 4 % 4 < cells.y && i / 16 < cells.z;
      EXPECT_EQ((bits >> i & 1) != 0, within) << i;
    }
  }
}

TEST(CellRectangles, HoldThePictureOfEachPointOfTheCell) {
  Volume volume = random_volume<std::uint8_t>({20, 20, 20}, 0, 255);
  volume.world_from_voxel[1] *= 3.0;
  const ExactWalk walk(volume, EmissionMap::window(0.0, 255.0));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::uniform_int_distribution<int> at(0, 3);
  for (const CameraOptions& options : cameras()) {
    const Camera camera = camera_of(volume, options);
    const CellRectangles rectangles(walk.field(), camera);
    const PixelRange frame{{0, 0}, camera.size - 1};
    for (int n = 0; n < 2000; ++n) {
      const glm::ivec3 brick = 4 * glm::ivec3(at(random), at(random), at(random));
      const int index = n % 64;
      const glm::ivec3 cell = brick + glm::ivec3(index % 4, index / 4 % 4, index / 16);
      const glm::dvec3 p = glm::dvec3(cell) + glm::dvec3(unit(random), unit(random), unit(random));
      const glm::dvec3 p_mm(volume.world_from_voxel * glm::dvec4(p, 1.0));
      glm::dvec3 from = p_mm - camera.target_mm;
      double w = 1.0;
      if (camera.perspective) {
        from = p_mm - eye_mm(camera);
        w = glm::dot(from, camera.forward);
        if (w <= 0.0) continue;
      }
      const double scale = 0.5 * std::min(camera.size.x, camera.size.y) / (camera.half_extent * w);
      // The pixel whose centre is nearest is covered where the point lies on the centre itself.
      const double x = 0.5 * camera.size.x + scale * glm::dot(from, camera.right);
      const double y = 0.5 * camera.size.y - scale * glm::dot(from, camera.up);
      for (const PixelRange& r : {rectangles.of(cell, 1, frame),
                                  CellRectangles::OfBrick(rectangles, brick, frame).cell(index),
                                  rectangles.of(brick, 4, frame)}) {
        // Centres less than the point's place from the edge are in: the edge is beyond the point.
        if (x > 0.5 && x < camera.size.x - 0.5) {
          EXPECT_LE(r.first.x - 0.5, x);
          EXPECT_GE(r.last.x + 1.5, x);
        }
        if (y > 0.5 && y < camera.size.y - 0.5) {
          EXPECT_LE(r.first.y - 0.5, y);
          EXPECT_GE(r.last.y + 1.5, y);
        }
      }
    }
  }
}

TEST(TileLists, HoldEachThingWhereItIsInOrder) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> x(0, 99);
  std::uniform_int_distribution<int> y(0, 69);
  std::vector<PixelRange> things;
  for (int i = 0; i < 3000; ++i) {
    const int x0 = x(random);
    const int y0 = y(random);
    const int x1 = std::min(100, x0 + x(random) / 8);
    const int y1 = std::min(70, y0 + y(random) / 8);
    things.push_back({{x0, y0}, {x1 - 1, y1 - 1}});
  }
  const TileLists lists = make_tile_lists(things, {100, 70}, 32);
  ASSERT_EQ(lists.tiles, glm::ivec2(4, 3));
  for (int tile = 0; tile < 12; ++tile) {
    const int left = tile % 4 * 32;
    const int top = tile / 4 * 32;
    const PixelRange area{{left, top}, {left + 31, top + 31}};
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < things.size(); ++i) {
      if (!things[i].empty() && !intersection(things[i], area).empty()) expected.push_back(i);
    }
    const auto found = lists.of(static_cast<std::size_t>(tile));
    EXPECT_EQ(std::vector<std::uint32_t>(found.begin(), found.end()), expected);
  }
}

}  // namespace
}  // namespace nacre
