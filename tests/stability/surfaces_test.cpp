// Marching cubes and snapping where numbers are extreme.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include "core/quantization_grid.h"
#include "extract/marching_cubes.h"
#include "io/non_finite.h"
#include "shells/snap.h"
#include "tests/stability/stability_case.h"
#include "tests/support/analytic_surfaces.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/test_volumes.h"

namespace nacre::testing {
namespace {

/// What keeps a mesh from being closed, oriented and without degenerate triangles, counted.
double flaws(const TriangleMesh& mesh) {
  const MeshFacts facts = facts_of(mesh);
  return static_cast<double>(facts.unpaired_edges + facts.repeated_edges + facts.degenerate +
                             facts.unused_vertices + (facts.finite ? 0 : 1));
}

/// Vertices that come to lie where another does already.
double coincident(const std::vector<glm::vec3>& positions) {
  std::set<std::tuple<float, float, float>> seen;
  double count = 0.0;
  for (const glm::vec3& p : positions) {
    if (!seen.insert({p.x, p.y, p.z}).second) ++count;
  }
  return count;
}

/// Where a level crosses the middle edge of four samples a, a, b, b along x, in voxels from the
/// edge's start: as extracted.
template <class T>
double crossing(T a, T b, double level) {
  const Volume volume =
      volume_of<T>({4, 3, 3}, [&](std::int64_t x, auto, auto) { return x < 2 ? a : b; });
  const std::vector<TriangleMesh> surfaces = extract_surfaces(volume, std::array{level});
  double place = -1.0;
  for (const glm::vec3& p : surfaces.front().positions) {
    // The box's centre is at 1.5 voxels; the caps lie at its ends.
    const double x = static_cast<double>(p.x) + 1.5;
    if (x > 1.0 && x < 2.0) place = x - 1.0;
  }
  return place;
}

/// The same in extended precision.
template <class T>
double exact_crossing(T a, T b, double level) {
  const auto from = static_cast<long double>(a);
  return static_cast<double>((static_cast<long double>(level) - from) /
                             (static_cast<long double>(b) - from));
}

/// Errors of places along an edge, where what is no number is as wrong as can be.
double place_error(double place, double truth) {
  return std::isfinite(place) ? std::min(std::abs(place - truth), 1.0) : 1.0;
}

constexpr double kPlaceBound = 1e-6;  // voxels: positions are floats of a few voxels

TEST(SurfaceStability, SamplesOneUlpFromTheLevel) {
  constexpr float level = 100.0F;
  const std::array<float, 4> near{level, std::nextafter(level, 0.0F), std::nextafter(level, 1e9F),
                                  50.0F};
  const Volume volume = volume_of<float>({9, 9, 9}, [&](auto x, auto y, auto z) {
    return near[static_cast<std::size_t>((7 * x + 5 * y + 3 * z + x * y * z) % 4)];
  });
  const TriangleMesh mesh =
      extract_surfaces(volume, std::array{static_cast<double>(level)}).front();
  // The formula alone: t = (v - a) / (b - a) is 0 or 1 where a sample equals the level.
  std::vector<glm::vec3> naive;
  const auto sample = [&](int x, int y, int z) {
    return near[static_cast<std::size_t>((7 * x + 5 * y + 3 * z + x * y * z) % 4)];
  };
  for (int z = 0; z < 9; ++z) {
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 8; ++x) {
        const float a = sample(x, y, z);
        const float b = sample(x + 1, y, z);
        if ((a >= level) == (b >= level)) continue;
        naive.emplace_back(static_cast<float>(x) + (level - a) / (b - a), y, z);
      }
    }
  }
  expect_held({.name = "marching cubes, samples at the level and one ulp from it",
               .unit = "flaws of the mesh",
               .bound = 0.0,
               .seen = flaws(mesh),
               .naive = coincident(naive),
               .naive_formula = "vertices at (v - a) / (b - a): those that coincide"});
}

TEST(SurfaceStability, ValuesFromTheLeastToTheGreatestFloat) {
  constexpr float a = -3e38F;
  constexpr float b = 3e38F;
  constexpr double level = 1e38;
  const auto naive = static_cast<double>((static_cast<float>(level) - a) / (b - a));
  expect_held({.name = "marching cubes, values from -3e38 to 3e38",
               .unit = "voxels",
               .bound = kPlaceBound,
               .seen = place_error(crossing(a, b, level), exact_crossing(a, b, level)),
               .naive = place_error(naive, exact_crossing(a, b, level)),
               .naive_formula = "(v - a) / (b - a) in floats"});
}

/// As P. Bourke's "Polygonising a scalar field" (1994) has it, and many programs after it: values
/// that differ by less than 1e-5 count as equal.
double guarded_crossing(float a, float b, float level) {
  return std::abs(b - a) < 1e-5F ? 0.0 : static_cast<double>((level - a) / (b - a));
}

TEST(SurfaceStability, ValuesOfTenToTheMinus38) {
  constexpr float b = 1e-38F;
  const double level = 0.375 * static_cast<double>(b);
  expect_held({.name = "marching cubes, values of 1e-38",
               .unit = "voxels",
               .bound = kPlaceBound,
               .seen = place_error(crossing(0.0F, b, level), exact_crossing(0.0F, b, level)),
               .naive = place_error(guarded_crossing(0.0F, b, static_cast<float>(level)), 0.375),
               .naive_formula = "differences below 1e-5 count as none"});
}

TEST(SurfaceStability, DenormalValues) {
  constexpr float b = 8.0F * std::numeric_limits<float>::denorm_min();
  const double level = 0.375 * static_cast<double>(b);
  const auto naive = static_cast<double>(static_cast<float>(level) * (1.0F / b));
  expect_held({.name = "marching cubes, denormal values",
               .unit = "voxels",
               .bound = kPlaceBound,
               .seen = place_error(crossing(0.0F, b, level), exact_crossing(0.0F, b, level)),
               .naive = place_error(naive, 0.375),
               .naive_formula = "v times the reciprocal of b, in floats"});
}

TEST(SurfaceStability, FullRangeIntegers) {
  constexpr std::int32_t a = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t b = std::numeric_limits<std::int32_t>::max();
  constexpr double level = 1e9;
  // What a subtraction of 32-bit integers leaves when it wraps.
  const auto wrapped =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(b) - static_cast<std::uint32_t>(a));
  const auto above = static_cast<std::int32_t>(static_cast<std::uint32_t>(1'000'000'000) -
                                               static_cast<std::uint32_t>(a));
  expect_held(
      {.name = "marching cubes, 32-bit integers over their full range",
       .unit = "voxels",
       .bound = kPlaceBound,
       .seen = place_error(crossing(a, b, level), exact_crossing(a, b, level)),
       .naive = place_error(static_cast<double>(above) / wrapped, exact_crossing(a, b, level)),
       .naive_formula = "subtracting as 32-bit integers"});
}

TEST(SurfaceStability, NotANumberAndInfinity) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Volume volume = volume_of<float>(
      {4, 4, 4}, [](auto x, auto y, auto z) { return static_cast<float>(x + y + z); });
  auto samples = samples_as<float>(volume);
  samples[21] = std::numeric_limits<float>::quiet_NaN();
  samples[42] = infinity;
  samples[5] = -infinity;
  VolumeReadReport report;
  replace_non_finite("test", volume, report);
  const TriangleMesh mesh = extract_surfaces(volume, std::array{4.5}).front();
  expect_held({.name = "NaN and infinite samples, replaced on reading",
               .unit = "flaws of the mesh",
               .bound = 0.0,
               .seen = flaws(mesh),
               .naive = std::isfinite((4.5F - infinity) / (1.0F - infinity)) ? 0.0 : 1.0,
               .naive_formula = "(v - a) / (b - a) of what the file holds: not finite"});
}

TEST(SurfaceStability, SpacingsOneToAThousand) {
  Volume volume = random_volume<float>({9, 8, 7}, 0.0, 1.0, 3);
  volume.world_from_voxel = glm::dmat4(1.0);
  volume.world_from_voxel[2][2] = 1000.0;
  const TriangleMesh mesh = extract_surfaces(volume, std::array{0.5}).front();
  // Welding by distance, a thousandth of the mean spacing as many a program has it.
  std::vector<glm::vec3> rounded;
  constexpr float kWeld = 0.334F;
  for (const glm::vec3& p : mesh.positions) {
    rounded.emplace_back(std::round(p.x / kWeld), std::round(p.y / kWeld), std::round(p.z / kWeld));
  }
  expect_held(
      {.name = "marching cubes, spacings 1 : 1000",
       .unit = "flaws of the mesh",
       .bound = 0.0,
       .seen = flaws(mesh),
       .naive = coincident(rounded),
       .naive_formula = "welding within a thousandth of the mean spacing: vertices joined"});
}

TEST(SurfaceStability, AxesOfOneSample) {
  for (const glm::i64vec3 dims : {glm::i64vec3(1, 1, 1), {1, 1, 4}, {1, 4, 4}}) {
    Volume volume = volume_of<std::uint8_t>(dims, [](auto, auto, auto) { return 9; });
    volume.world_from_voxel = glm::dmat4(1.0);
    volume.world_from_voxel[0][0] = 0.5;
    const TriangleMesh mesh = extract_surfaces(volume, std::array{5.0}).front();
    const auto side = [](std::int64_t n) { return n == 1 ? 1.0 : static_cast<double>(n - 1); };
    const double truth = 0.5 * side(dims.x) * side(dims.y) * side(dims.z);
    const auto span = [](std::int64_t n) { return static_cast<double>(n - 1); };
    const double naive = 0.5 * span(dims.x) * span(dims.y) * span(dims.z);
    const int thin = static_cast<int>(dims.x == 1) + static_cast<int>(dims.y == 1) +
                     static_cast<int>(dims.z == 1);
    expect_held({.name = "volumes of one sample along " + std::to_string(thin) +
                         (thin == 1 ? " axis" : " axes"),
                 .unit = "enclosed volume, relative",
                 .bound = 1e-6,
                 .seen = flaws(mesh) > 0.0 ? 1.0 : std::abs(facts_of(mesh).volume / truth - 1.0),
                 .naive = std::abs(naive / truth - 1.0),
                 .naive_formula = "an extent of (n - 1) spacings"});
  }
}

TEST(SurfaceStability, LevelsOneUlpApart) {
  // One sample of 100 among zeros: it is inside at the level 100, outside one ulp above it.
  const Volume volume = volume_of<float>(
      {5, 5, 5}, [](auto x, auto y, auto z) { return x == 2 && y == 2 && z == 2 ? 100.0F : 0.0F; });
  const double above = std::nextafter(100.0, 200.0);
  const std::vector<TriangleMesh> surfaces = extract_surfaces(volume, std::array{100.0, above});
  const double seen = (surfaces[0].triangles.empty() ? 1.0 : flaws(surfaces[0])) +
                      static_cast<double>(surfaces[1].triangles.size());
  expect_held({.name = "levels one ulp apart about a sample",
               .unit = "flaws, and triangles that should not be",
               .bound = 0.0,
               .seen = seen,
               .naive = 100.0F >= static_cast<float>(above) ? 1.0 : 0.0,
               .naive_formula = "comparing as floats: samples on the wrong side"});
}

TEST(SurfaceStability, QuantisationCoarserThanTheGap) {
  // A crust of half a step: its two sheets fall on the same grid points.
  QuantizationGrid grid;
  grid.bits = 10;
  grid.range_mm = 1023.0 * 0.25;
  grid.origin_mm = glm::dvec3(-128.0);
  ASSERT_TRUE(is_exact(grid));
  const TriangleMesh crust =
      together(sphere_surface(5.0F, 24), turned_inside_out(sphere_surface(4.875F, 24)));
  const TriangleMesh snapped = snap(crust, grid).mesh;
  std::vector<glm::vec3> naive;
  for (const glm::vec3& p : crust.positions) {
    naive.push_back(grid_position(grid, nearest_index(grid, glm::dvec3(p))));
  }
  expect_held({.name = "two sheets half a quantisation step apart",
               .unit = "flaws, and vertices that coincide",
               .bound = 0.0,
               .seen = flaws(snapped) + coincident(snapped.positions),
               .naive = coincident(naive),
               .naive_formula = "rounding each vertex to the nearest grid point"});
}

}  // namespace
}  // namespace nacre::testing
