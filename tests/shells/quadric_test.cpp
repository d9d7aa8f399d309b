#include "shells/quadric.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace nacre {
namespace {

TEST(Quadric, IsTheSumOfSquaredDistances) {
  Quadric quadric;
  quadric.add({1, 0, 0}, -2.0, 1.0);
  quadric.add({0, 2, 1}, 0.5, 3.0);
  const glm::dvec3 p(0.3, -1.2, 0.7);
  const double first = p.x - 2.0;
  const double second = 2.0 * p.y + p.z + 0.5;
  EXPECT_NEAR(quadric(p), first * first + 3.0 * second * second, 1e-12);
  EXPECT_DOUBLE_EQ(quadric.weight, 4.0);
}

TEST(Quadric, IsLeastWhereThePlanesMeet) {
  const glm::dvec3 corner(1.5, -0.25, 3.0);
  Quadric quadric;
  for (const glm::dvec3& n : {glm::dvec3(1, 0.2, 0), glm::dvec3(0, 1, -0.3), glm::dvec3(0.5, 0, 1)})
    quadric.add(n, -glm::dot(n, corner), 0.7);
  const glm::dvec3 from(0.0);
  EXPECT_LT(glm::distance(from + quadric.step_to_least(from, 1e-12), corner), 1e-9);
}

// Along a plane nothing changes: whoever is on it stays, whoever is not comes straight.
TEST(Quadric, LeavesFreeDirectionsAlone) {
  Quadric quadric;
  quadric.add({0, 0, 1}, -2.0, 1.0);
  const glm::dvec3 step = quadric.step_to_least({5, 7, 0}, 1e-6);
  EXPECT_NEAR(step.z, 2.0, 1e-5);
  EXPECT_NEAR(step.x, 0.0, 1e-12);
  EXPECT_NEAR(step.y, 0.0, 1e-12);
  EXPECT_EQ(Quadric{}.step_to_least({1, 2, 3}, 1e-3), glm::dvec3(0.0));
}

TEST(SymmetricSolve, SolvesAndRefusesSingularSystems) {
  const glm::dvec3 diagonal(4, 5, 6);
  const glm::dvec3 beside(1, -0.5, 0.25);
  const glm::dvec3 x(1, -2, 3);
  const glm::dvec3 right(4 * x.x + 1 * x.y - 0.5 * x.z, 1 * x.x + 5 * x.y + 0.25 * x.z,
                         -0.5 * x.x + 0.25 * x.y + 6 * x.z);
  EXPECT_LT(glm::distance(solve_symmetric(diagonal, beside, right), x), 1e-12);
  EXPECT_EQ(solve_symmetric({1, 0, 0}, {0, 0, 0}, {1, 1, 1}), glm::dvec3(0.0));
}

}  // namespace
}  // namespace nacre
