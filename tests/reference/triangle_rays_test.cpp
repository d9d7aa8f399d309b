#include "reference/triangle_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <random>

#include "core/triangle_mesh.h"
#include "tests/support/nested_shells.h"

namespace nacre {
namespace {

using testing::ball_mesh;
using testing::block_mesh;
using testing::ring_mesh;

#ifdef NDEBUG
constexpr int kSomeRays = 60'000;
#else
constexpr int kSomeRays = 2'000;
#endif

/// NACRE_THOROUGH=1: millions.
int ray_count() { return std::getenv("NACRE_THOROUGH") != nullptr ? 3'000'000 : kSomeRays; }

std::vector<glm::dvec3> in_double(const TriangleMesh& mesh) {
  return {mesh.positions.begin(), mesh.positions.end()};
}

TriangleRays rays_of(const TriangleMesh& mesh) { return {in_double(mesh), mesh.triangles}; }

Ray ray_through(const glm::dvec3& a, const glm::dvec3& b) { return {a, glm::normalize(b - a)}; }

/// Draws numbers and points for the tests below.
class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}

  double number(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random_);
  }
  std::uint32_t below(std::size_t count) {
    return std::uniform_int_distribution<std::uint32_t>(
        0, static_cast<std::uint32_t>(count) - 1)(random_);
  }
  glm::dvec3 point(double reach) {
    return {number(-reach, reach), number(-reach, reach), number(-reach, reach)};
  }
  /// A small whole number in each coordinate: rays and triangles that meet exactly.
  glm::dvec3 lattice_point(int reach) {
    return glm::dvec3(below(2 * reach + 1), below(2 * reach + 1), below(2 * reach + 1)) -
           static_cast<double>(reach);
  }
  /// A vertex, or a point of an edge (as near as doubles get to it).
  glm::dvec3 critical_point(const TriangleMesh& mesh) {
    const glm::uvec3& t = mesh.triangles[below(mesh.triangles.size())];
    const glm::dvec3 a(mesh.positions[t.x]);
    const glm::dvec3 b(mesh.positions[t.y]);
    switch (below(4)) {
      case 0: return a;
      case 1: return 0.5 * (a + b);
      default: return a + number(0.0, 1.0) * (b - a);
    }
  }

 private:
  std::mt19937_64 random_;
};

/// Every triangle, one by one.
std::vector<TriangleHit> brute_force(const TriangleMesh& mesh, const Ray& ray,
                                     const RayInterval& interval) {
  const RayCoordinates frame(ray);
  std::vector<TriangleHit> hits;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const auto met = crossing(frame(mesh.positions[t.x]), frame(mesh.positions[t.y]),
                              frame(mesh.positions[t.z]));
    if (met && met->t_mm >= interval.t_begin_mm && met->t_mm <= interval.t_end_mm) {
      hits.push_back({*met, i});
    }
  }
  std::ranges::stable_sort(hits, {}, &TriangleHit::t_mm);
  return hits;
}

void expect_same(const TriangleRays& rays, const TriangleMesh& mesh, const Ray& ray,
                 const RayInterval& interval) {
  const auto expected = brute_force(mesh, ray, interval);
  const auto found = rays.all(ray, interval);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].triangle, expected[i].triangle);
    EXPECT_EQ(found[i].t_mm, expected[i].t_mm);
    EXPECT_EQ(found[i].entering, expected[i].entering);
  }
  const auto nearest = rays.nearest(ray, interval);
  ASSERT_EQ(nearest.has_value(), !expected.empty());
  if (nearest) {
    EXPECT_EQ(nearest->triangle, expected.front().triangle);
  }
}

int balance(const std::vector<TriangleHit>& hits) {
  int sum = 0;
  for (const TriangleHit& hit : hits) sum += hit.entering ? 1 : -1;
  return sum;
}

TEST(TriangleCrossing, SignsOfDifferencesAreExact) {
  __extension__ using Wide = __int128;
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> number(-(1LL << 53), 1LL << 53);
  std::uniform_int_distribution<std::int64_t> small(-2, 2);
  const auto is_exact = [](std::int64_t x) { return std::abs(x) <= (1LL << 53); };
  for (int trial = 0; trial < 20'000; ++trial) {
    const std::int64_t a = number(random);
    const std::int64_t b = number(random);
    // Products that differ by a few units in their last of 106 bits.
    const std::int64_t c = a + small(random);
    const std::int64_t d = b + small(random);
    if (!is_exact(c) || !is_exact(d)) continue;
    const Wide difference = Wide{a} * b - Wide{c} * d;
    const int expected = (difference > 0 ? 1 : 0) - (difference < 0 ? 1 : 0);
    for (const double scale : {1.0, 0x1p-600, 0x1p+300}) {
      EXPECT_EQ(sign_of_difference(scale * static_cast<double>(a), scale * static_cast<double>(b),
                                   scale * static_cast<double>(c), scale * static_cast<double>(d)),
                expected);
    }
  }
  EXPECT_EQ(sign_of_difference(0x1p-600, 0x1p-600, 0x1p-601, 0x1p-600), 1);
  EXPECT_EQ(sign_of_difference(0x1p-600, -0x1p-600, 0x1p-601, -0x1p-600), -1);
  EXPECT_EQ(sign_of_difference(0x1p-900, 0x1p-400, 0x1p-400, 0x1p-900), 0);
  EXPECT_EQ(sign_of_difference(0.0, 5.0, 0x1p-600, 0x1p-600), -1);
}

TEST(TriangleRays, ABlockIsEnteredAndLeftWhereItsWallsAre) {
  const TriangleMesh block = block_mesh({-1, -2, -3}, {4, 5, 6});
  const TriangleRays rays = rays_of(block);
  const Ray ray = ray_through({-10, 0.25, 0.5}, {10, 0.25, 0.5});
  const auto hits = rays.all(ray);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_TRUE(hits[0].entering);
  EXPECT_DOUBLE_EQ(hits[0].t_mm, 9.0);
  EXPECT_FALSE(hits[1].entering);
  EXPECT_DOUBLE_EQ(hits[1].t_mm, 14.0);
  EXPECT_EQ(rays.all(ray, {10.0, 13.0}).size(), 0u);
  EXPECT_EQ(rays.all(ray, {9.0, 9.0}).size(), 1u);
  EXPECT_FALSE(rays.nearest(ray, {15.0, INFINITY}));
  const auto behind = rays.nearest({{10, 0.25, 0.5}, {1, 0, 0}});
  ASSERT_TRUE(behind);
  EXPECT_DOUBLE_EQ(behind->t_mm, -11.0);
}

TEST(TriangleRays, ThroughEveryVertexOfABlockGoesAsMuchInAsOut) {
  const TriangleMesh block = block_mesh({-1, -2, -3}, {4, 5, 6});
  const TriangleRays rays = rays_of(block);
  for (const glm::vec3& corner : block.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      Ray along{corner, {0, 0, 0}};  // along edges, in faces
      for (const double way : {-1.0, 1.0}) {
        along.direction[axis] = way;
        EXPECT_EQ(balance(rays.all(along)), 0);
      }
    }
    const auto hits = rays.all(ray_through({0, 0, 0}, corner), {0.0, INFINITY});
    EXPECT_EQ(hits.size(), 1u) << "from inside a convex surface there is one way out";
  }
}

TEST(TriangleRays, AgreeWithEveryTriangleOnSoupThatMeetsRaysExactly) {
  Dice dice(2);
  for (int trial = 0; trial < 12; ++trial) {
    TriangleMesh soup;
    constexpr std::uint32_t kTriangles = 200;
    for (std::uint32_t i = 0; i < 3 * kTriangles; ++i) {
      soup.positions.emplace_back(trial % 2 == 0 ? dice.lattice_point(4) : dice.point(4.0));
    }
    for (std::uint32_t i = 0; i < kTriangles; ++i) {  // shared corners, and some repeated ones
      soup.triangles.emplace_back(dice.below(3 * kTriangles), dice.below(3 * kTriangles),
                                  i % 10 == 0 ? 7 : dice.below(3 * kTriangles));
    }
    const TriangleRays rays = rays_of(soup);
    for (int i = 0; i < kSomeRays / 120; ++i) {
      const glm::dvec3 from = i % 3 == 0 ? dice.point(10.0) : dice.lattice_point(6);
      const glm::dvec3 to = i % 2 == 0 ? dice.lattice_point(5) : dice.critical_point(soup);
      if (from == to) continue;
      expect_same(rays, soup, ray_through(from, to), {});
      expect_same(rays, soup, ray_through(from, to), {dice.number(-3, 3), dice.number(3, 9)});
    }
    for (int axis = 0; axis < 3; ++axis) {
      Ray ray{dice.lattice_point(4), {0, 0, 0}};
      ray.direction[axis] = trial % 2 == 0 ? 1.0 : -1.0;
      expect_same(rays, soup, ray, {});
    }
  }
}

TEST(TriangleRays, ClosedSurfacesHaveNoGapAtTheirEdgesAndVertices) {
  Dice dice(3);
  const int count = ray_count();
  for (const TriangleMesh& mesh :
       {ball_mesh({0.3, 0.1, -0.2}, 2.0, 24), ring_mesh({-0.5, 0.25, 0.125}, 3.0, 1.0, 48)}) {
    const TriangleRays rays = rays_of(mesh);
    for (int i = 0; i < count; ++i) {
      const glm::dvec3 from = i % 2 == 0 ? dice.point(5.0) : dice.critical_point(mesh);
      const glm::dvec3 to = dice.critical_point(mesh);
      if (from == to) continue;
      ASSERT_EQ(balance(rays.all(ray_through(from, to))), 0) << i;
    }
  }
}

TEST(TriangleRays, FromWithinABallThereIsOneWayOutWhereverItIsAimed) {
  Dice dice(4);
  const int count = ray_count();
  const TriangleMesh ball = ball_mesh({100.5, -2000.25, 30.125}, 2.0, 30);
  const TriangleRays rays = rays_of(ball);
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 from = glm::dvec3(100.5, -2000.25, 30.125) + dice.point(1.0);
    const auto hits = rays.all(ray_through(from, dice.critical_point(ball)), {0.0, INFINITY});
    ASSERT_EQ(hits.size(), 1u) << i;
    ASSERT_FALSE(hits.front().entering);
  }
}

TEST(TriangleRays, KeepTheirDistancesFarAway) {
  Dice dice(5);
  const TriangleMesh ball = ball_mesh({0, 0, 0}, 2.0, 30);
  const TriangleRays rays = rays_of(ball);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 away = glm::normalize(dice.point(1.0));
    const auto hits = rays.all(ray_through(1e6 * away, {0, 0, 0}));
    ASSERT_EQ(hits.size(), 2u);
    EXPECT_NEAR(hits[0].t_mm, 1e6 - 2.0, 0.02);  // the mesh is inscribed
    expect_same(rays, ball, ray_through(1e6 * away, dice.critical_point(ball)), {});
  }
}

TEST(TriangleRays, CrowdedTrianglesStayWithinTheirDepth) {
  TriangleMesh mesh;  // each half as far from the corner as the last, then many in one place
  for (std::uint32_t i = 0; i < 400; ++i) {
    const float size = std::ldexp(1.0f, i < 120 ? -static_cast<int>(i) : -120);
    for (const glm::vec3& p : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
      mesh.positions.push_back(size * p);
    }
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  const TriangleRays rays = rays_of(mesh);
  EXPECT_EQ(rays.all(ray_through({0, 0, 0}, {1, 1, 1})).size(), 400u);
}

TEST(TriangleRays, NothingIsMetWhereThereIsNothing) {
  const TriangleRays none({}, {});
  EXPECT_FALSE(none.nearest({{0, 0, 0}, {1, 0, 0}}));
  const std::vector<glm::uvec3> points{{0, 0, 0}, {0, 1, 0}, {0, 1, 2}};
  const TriangleRays flat({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, points);
  EXPECT_FALSE(flat.nearest({{0, 0, 0}, {1, 0, 0}}));
  EXPECT_FALSE(flat.nearest(ray_through({-1, -1, -1}, {1, 1, 1})));
}

}  // namespace
}  // namespace nacre
