#include "reference/layer_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "core/error.h"
#include "core/volume_geometry.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

using testing::random_volume;
using testing::volume_of;

const EmissionMap kUnit = EmissionMap::window(0.0, 1.0);
#ifdef NDEBUG
constexpr int kRays = 40;
#else
constexpr int kRays = 6;
#endif

std::vector<ShownLevel> uniform(int n) {
  std::vector<ShownLevel> levels;
  for (int k = 1; k <= n; ++k) levels.push_back({(k - 0.5) / n, static_cast<double>(k) / n});
  return levels;
}

Ray ray_through(const glm::dvec3& a, const glm::dvec3& b) { return {a, glm::normalize(b - a)}; }

/// Random lines that hit a volume's sphere.
std::vector<Ray> random_rays(const BoundingSphere& sphere, int count) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const glm::dvec3 aside(normal(random), normal(random), normal(random));
    rays.push_back(
        {sphere.center_mm + 0.3 * sphere.radius_mm * aside - 3.0 * sphere.radius_mm * d, d});
  }
  return rays;
}

/// v = x along a box of 11 x 3 x 3 samples, 0 to 1 over 10 mm.
Volume ramp() {
  return volume_of<double>({11, 3, 3},
                           [](auto x, auto, auto) { return static_cast<double>(x) / 10.0; });
}

const Ray kAlong{{-5.0, 1.2, 0.7}, {1.0, 0.0, 0.0}};  // enters the ramp at t = 5, leaves at 15
const Ray kAgainst{{15.0, 1.2, 0.7}, {-1.0, 0.0, 0.0}};

TEST(LayerWalk, ARampShowsItsLayers) {
  const Volume volume = ramp();
  const ExactWalk walk(volume, kUnit);
  const std::vector<ShownLevel> levels{{0.25, 0.3}, {0.5, 0.7}, {0.9, 0.4}};  // not ascending
  const LayerWalk layers(walk, levels);
  const CueField cue{0.5, {5.0, 1.0, 1.0}, {-0.1, 0.0, 0.0}};  // 1 - x / 10
  for (const Ray& ray : {kAlong, kAgainst}) {
    // Inside shell 2 from x = 5 on, where the third, dimmer, is inside it.
    EXPECT_NEAR(layers.max_emission(ray), 0.7, 1e-15);
    EXPECT_NEAR(layers.emission_integral(ray), 2.5 * 0.3 + 4.0 * 0.7 + 1.0 * 0.4, 1e-13);
    // r beta where each shell begins: 0.3 * 0.75, 0.7 * 0.5, 0.4 * 0.1.
    EXPECT_NEAR(layers.max_emission(ray, {}, cue), 0.35, 1e-14);
    EXPECT_NEAR(layers.emission_integral(ray, {}, cue),
                0.3 * 2.5 * 0.625 + 0.7 * 4.0 * 0.3 + 0.4 * 1.0 * 0.05, 1e-13);
    // Through all three, and out through their caps.
    EXPECT_NEAR(layers.count(ray), 2.0 * (0.3 + 0.7 + 0.4), 1e-14);
  }
}

TEST(LayerWalk, MeetsTheRampsSurfacesAndCaps) {
  const Volume volume = ramp();
  const ExactWalk walk(volume, kUnit);
  const LayerWalk layers(walk, uniform(2));  // at 0.25 and 0.75
  const auto along = layers.first_surface(kAlong);
  ASSERT_TRUE(along.has_value());
  EXPECT_NEAR(along->t_mm, 7.5, 1e-14);
  EXPECT_EQ(along->level, 0u);
  EXPECT_NEAR(glm::length(along->normal - glm::dvec3(-1, 0, 0)), 0.0, 1e-14);
  // From the bright end the border plane comes first: the cap of the outer shell.
  const auto against = layers.first_surface(kAgainst);
  ASSERT_TRUE(against.has_value());
  EXPECT_NEAR(against->t_mm, 5.0, 1e-14);
  EXPECT_EQ(against->level, 0u);
  EXPECT_EQ(against->normal, glm::dvec3(1, 0, 0));
  // From aside, through the cap in the plane y = 0.
  const auto aside = layers.first_surface({{8.0, -3.0, 1.0}, {0.0, 1.0, 0.0}});
  ASSERT_TRUE(aside.has_value());
  EXPECT_NEAR(aside->t_mm, 3.0, 1e-14);
  EXPECT_EQ(aside->normal, glm::dvec3(0, -1, 0));
}

TEST(LayerWalk, ARayThatStartsInsideMeetsTheNextSurfaceFromInside) {
  const Volume volume = ramp();
  const ExactWalk walk(volume, kUnit);
  const LayerWalk layers(walk, uniform(2));
  // From x = 5, between the shells.
  const auto inner = layers.first_surface(kAlong, {10.0, 99.0});
  ASSERT_TRUE(inner.has_value());
  EXPECT_NEAR(inner->t_mm, 12.5, 1e-14);
  EXPECT_EQ(inner->level, 1u);
  const auto outer = layers.first_surface(kAgainst, {10.0, 99.0});
  ASSERT_TRUE(outer.has_value());
  EXPECT_NEAR(outer->t_mm, 12.5, 1e-14);
  EXPECT_EQ(outer->level, 0u);
  EXPECT_GT(glm::dot(outer->normal, kAgainst.direction), 0.99);  // seen from inside
  // From x = 9, inside both: out through the inner one's cap.
  const auto cap = layers.first_surface(kAlong, {14.0, 99.0});
  ASSERT_TRUE(cap.has_value());
  EXPECT_NEAR(cap->t_mm, 15.0, 1e-14);
  EXPECT_EQ(cap->level, 1u);
  EXPECT_EQ(cap->normal, glm::dvec3(1, 0, 0));
  // Cut off before it, nothing is met; nor counted.
  EXPECT_FALSE(layers.first_surface(kAlong, {14.0, 14.5}).has_value());
  EXPECT_EQ(layers.count(kAlong, {14.0, 14.5}), 0.0);
  EXPECT_NEAR(layers.count(kAlong, {10.0, 99.0}), 1.0 + 1.0 + 0.5, 1e-15);
}

TEST(LayerWalk, ARayThatBeginsInABorderFaceMeetsItsCap) {
  const Volume volume = ramp();
  const ExactWalk walk(volume, kUnit);
  const LayerWalk layers(walk, uniform(1));
  EXPECT_TRUE(layers.first_surface(kAgainst, {5.0, 6.0}).has_value());
  EXPECT_FALSE(layers.first_surface(kAgainst, {5.01, 6.0}).has_value());
}

TEST(LayerWalk, CountsNestedSpheresTwice) {
  // v = R - |p| on a fine grid: every line through the ball enters and leaves each shell once.
  const double radius = 10.0;
  const Volume volume = volume_of<float>({41, 41, 41}, [&](auto x, auto y, auto z) {
    const glm::dvec3 p(0.6 * glm::dvec3(x - 20, y - 20, z - 20));
    return std::max(0.0, 1.0 - glm::length(p) / radius);
  });
  const ExactWalk walk(volume, kUnit);
  const std::vector<ShownLevel> levels = uniform(8);
  const LayerWalk layers(walk, levels);
  for (const double delta : {0.3, 2.0, 4.7, 8.1}) {
    double expected = 0.0;
    double chords = 0.0;
    double least = 0.0;
    for (const auto& [value, representative] : levels) {
      const double r = radius * (1.0 - value);
      if (r <= delta) break;
      expected += 2.0 * representative;
      chords += 2.0 * std::sqrt(r * r - delta * delta) / 8.0;
      least = representative;
    }
    const Ray ray{{20.0 + delta / 0.6, 20.1, -30.0}, {0.0, 0.0, 1.0}};
    EXPECT_NEAR(layers.count(ray), expected, 1e-12) << delta;
    EXPECT_EQ(layers.max_emission(ray), least) << delta;
    // The grid's trilinear ball is a little smaller than the true one.
    EXPECT_NEAR(0.6 * layers.emission_integral(ray) / chords, 1.0, 0.05) << delta;
  }
}

TEST(LayerWalk, NormalsAreThoseOfTheFieldInAnyFrame) {
  // A linear field keeps its gradient under any frame; the normal must follow it.
  const glm::dvec3 g(0.02, -0.03, 0.05);  // per mm
  for (const double slope : {1.0, -2.0}) {
    for (const double mirror : {1.0, -1.0}) {
      glm::dmat4 frame(1.0);
      frame[0] = {mirror * 0.5, 0.1, 0.0, 0.0};
      frame[1] = {-0.1, 0.7, 0.2, 0.0};
      frame[2] = {0.0, -0.2, 1.5, 0.0};
      frame[3] = {-30.0, 50.0, 7.0, 1.0};
      Volume volume = volume_of<double>({9, 8, 7}, [&](auto x, auto y, auto z) {
        const glm::dvec3 p(frame * glm::dvec4(x, y, z, 1.0));
        const glm::dvec3 center(frame * glm::dvec4(4.0, 3.5, 3.0, 1.0));
        return (0.5 + glm::dot(g, p - center)) / slope;
      });
      volume.slope = slope;
      volume.world_from_voxel = frame;
      const ExactWalk walk(volume, kUnit);
      const LayerWalk layers(walk, uniform(1));
      const glm::dvec3 center(frame * glm::dvec4(4.0, 3.5, 3.0, 1.0));
      const glm::dvec3 d = glm::normalize(glm::dvec3(0.1, -0.4, 1.0));
      const auto hit = layers.first_surface({center - 0.5 * d, d}, {0.0, 10.0});
      ASSERT_TRUE(hit.has_value());
      EXPECT_NEAR(hit->t_mm, 0.5, 1e-12);
      EXPECT_NEAR(glm::length(hit->normal + glm::normalize(g)), 0.0, 1e-12);
      // Caps: the border planes of a sheared box are not at right angles to its axes.
      const Ray through_face{center + 30.0 * d, -d};
      const auto cap = layers.first_surface(through_face);
      ASSERT_TRUE(cap.has_value());
      EXPECT_NEAR(glm::dot(cap->normal, glm::dvec3(frame[0])), 0.0, 1e-12);
      EXPECT_NEAR(glm::dot(cap->normal, glm::dvec3(frame[1])), 0.0, 1e-12);
      EXPECT_GT(glm::dot(cap->normal, d), 0.0);
      EXPECT_NEAR(glm::length(cap->normal), 1.0, 1e-14);
    }
  }
}

TEST(LayerWalk, NormalsHoldFromTheSmallestToTheLargestSamples) {
  for (const double scale : {5e-320, 1e-300, 1e-38, 1e38, 1e308}) {
    const Volume volume = volume_of<double>({3, 3, 3}, [scale](auto x, auto y, auto) {
      return scale * (0.25 * static_cast<double>(x) + 0.25 * static_cast<double>(y));
    });
    const ExactWalk walk(volume, EmissionMap::window(0.0, scale));
    const std::vector<ShownLevel> levels{{0.3 * scale, 1.0}};
    const LayerWalk layers(walk, levels);
    const auto hit = layers.first_surface({{-4.0, 0.125, 1.0}, {1.0, 0.0, 0.0}});
    ASSERT_TRUE(hit.has_value()) << scale;
    const double half = std::sqrt(0.5);
    EXPECT_NEAR(glm::length(hit->normal - glm::dvec3(-half, -half, 0.0)), 0.0, 1e-3) << scale;
  }
}

/// Straightforward layers by even samples of the field: shares nothing with the walk but
/// `max_value` at points.
struct SampledLayers {
  double max = 0.0;
  double sum = 0.0;
};

SampledLayers sampled_layers(const ExactWalk& walk, const std::vector<ShownLevel>& levels,
                             const Ray& ray, const CueField& cue, double from, double to,
                             double step) {
  SampledLayers sampled;
  for (double t = from + 0.5 * step; t < to; t += step) {
    const glm::dvec3 p = ray.origin_mm + t * ray.direction;
    const double value = walk.max_value({p, ray.direction}, {0.0, 1e-9});
    const double beta = cue.at_center + glm::dot(cue.rise_per_mm, p - cue.center_mm);
    double layer = 0.0;
    for (const auto& [v, r] : levels) {
      if (!(value >= v)) break;
      layer = r;
      sampled.max = std::max(sampled.max, beta * r);
    }
    sampled.sum += step * beta * layer;
  }
  return sampled;
}

TEST(LayerWalk, AgreesWithSamplesOnNoise) {
  const Volume volume = random_volume<std::uint8_t>({12, 11, 10}, 0, 255);
  const ExactWalk walk(volume, EmissionMap::window(0.0, 255.0));
  std::vector<ShownLevel> levels;
  for (int k = 0; k < 9; ++k) levels.push_back({30.5 + 25.0 * k, 0.1 + 0.9 * ((k * 4) % 9) / 8.0});
  const LayerWalk layers(walk, levels);
  const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
  const CueField cue{0.5, sphere.center_mm, glm::dvec3(0.02, -0.03, 0.01)};
  constexpr double kStep = 2e-3;
  for (const Ray& ray : random_rays(sphere, kRays / 4)) {
    const double to = 6.0 * sphere.radius_mm;
    const SampledLayers sampled = sampled_layers(walk, levels, ray, cue, 0.0, to, kStep);
    EXPECT_GE(layers.max_emission(ray, {}, cue), sampled.max - 1e-12);
    EXPECT_NEAR(layers.max_emission(ray, {}, cue), sampled.max, 0.01);
    EXPECT_NEAR(layers.emission_integral(ray, {}, cue), sampled.sum, 0.03);
  }
}

TEST(LayerWalk, ManyLevelsConvergeToTheExactPicture) {
  const Volume volume = random_volume<std::uint16_t>({20, 18, 16}, 0, 1000);
  const EmissionMap map = EmissionMap::window(100.0, 900.0);
  const ExactWalk walk(volume, map);
  const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
  const CueField cue{0.6, sphere.center_mm, glm::dvec3(0.01, -0.02, 0.01)};
  for (const int n : {12, 200}) {
    std::vector<ShownLevel> levels = uniform(n);
    for (ShownLevel& level : levels) level.value = map.value_at(level.value);
    const LayerWalk layers(walk, levels);
    for (const Ray& ray : random_rays(sphere, kRays)) {
      // Emission is off by at most half a layer, brighter or darker; beta is at most 1.
      EXPECT_NEAR(layers.max_emission(ray), walk.max_emission(ray), 0.5 / n + 1e-12);
      EXPECT_NEAR(layers.max_emission(ray, {}, cue), walk.max_emission(ray, {}, cue),
                  0.5 / n + 1e-12);
      EXPECT_NEAR(layers.emission_integral(ray, {}, cue), walk.emission_integral(ray, {}, cue),
                  2.0 * sphere.radius_mm * 0.5 / n);
    }
  }
}

TEST(LayerWalk, EntriesAndExitsBalance) {
  // With one shell of brightness 1, a line from outside to outside crosses it an even number of
  // times: through noise, along faces and edges, at levels that samples have exactly.
  const Volume volume = random_volume<std::uint8_t>({24, 23, 22}, 0, 7);
  const ExactWalk walk(volume, EmissionMap::window(0.0, 7.0));
  const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
  std::vector<Ray> rays = random_rays(sphere, kRays);
  for (const double offset : {0.0, 3.0, 10.5, 22.0}) {
    for (const glm::dvec3 d : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 1), glm::dvec3(1, 1, 1),
                               glm::dvec3(1, 1e-13, 0), glm::dvec3(-1, 0, -1e-12)}) {
      rays.push_back({glm::dvec3(offset) - 60.0 * glm::normalize(d), glm::normalize(d)});
    }
  }
  for (const double value : {3.0, 3.5}) {
    const std::vector<ShownLevel> one{{value, 1.0}};
    const LayerWalk layers(walk, one);
    for (const Ray& ray : rays) {
      const double count = layers.count(ray);
      EXPECT_EQ(count, 2.0 * std::round(count / 2.0));
    }
  }
}

TEST(LayerWalk, IntervalsOfOneRayAddUp) {
  const Volume volume = random_volume<float>({15, 14, 13}, 0.0, 1.0);
  const ExactWalk walk(volume, kUnit);
  const LayerWalk layers(walk, uniform(7));
  const CueField cue{0.6, glm::dvec3(7.0), {0.02, 0.01, 0.0}};
  const Ray ray = ray_through({-5, 1, 2}, {17, 9, 12});
  for (const double cut : {6.0, 11.3, 17.0}) {
    EXPECT_NEAR(layers.count(ray, {-1e9, cut}) + layers.count(ray, {cut, 1e9}), layers.count(ray),
                1e-12);
    EXPECT_NEAR(layers.emission_integral(ray, {-1e9, cut}, cue) +
                    layers.emission_integral(ray, {cut, 1e9}, cue),
                layers.emission_integral(ray, {}, cue), 1e-11);
    EXPECT_NEAR(std::max(layers.max_emission(ray, {-1e9, cut}, cue),
                         layers.max_emission(ray, {cut, 1e9}, cue)),
                layers.max_emission(ray, {}, cue), 1e-13);
  }
}

// The iso surface's first crossing has the level's value, and everything before it is below.
TEST(LayerWalk, TheFirstSurfaceIsTheFirst) {
  const Volume volume = random_volume<std::int16_t>({16, 15, 14}, -100, 100);
  const ExactWalk walk(volume, EmissionMap::window(-100.0, 100.0));
  const std::vector<ShownLevel> one{{60.0, 1.0}};
  const LayerWalk layers(walk, one);
  int met = 0;
  for (const Ray& ray :
       random_rays(bounding_sphere(volume.dims, volume.world_from_voxel), 5 * kRays)) {
    const auto hit = layers.first_surface(ray);
    if (!hit) {
      const double most = walk.max_value(ray);
      EXPECT_TRUE(std::isnan(most) || most < 60.0);
      continue;
    }
    ++met;
    const double before = walk.max_value(ray, {-1e9, hit->t_mm});
    const double after = walk.max_value(ray, {hit->t_mm, 1e9});
    EXPECT_TRUE(std::isnan(before) || before <= 60.0 + 1e-10);
    EXPECT_GE(after, 60.0 - 1e-10);
    EXPECT_LE(glm::dot(hit->normal, ray.direction), 1e-9);
  }
  EXPECT_GT(met, kRays);
}

TEST(LayerWalk, RefusesBadLevels) {
  const Volume volume = ramp();
  const ExactWalk walk(volume, kUnit);
  using Levels = std::vector<ShownLevel>;
  for (const Levels& levels : {Levels{}, Levels{{0.5, 1.0}, {0.2, 1.0}}, Levels{{0.5, 1.5}},
                               Levels{{NAN, 1.0}}, Levels{{0.5, NAN}}}) {
    EXPECT_THROW(LayerWalk(walk, levels), Error);
  }
}

}  // namespace
}  // namespace nacre
