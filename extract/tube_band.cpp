#include "extract/tube_band.h"

#include <cassert>
#include <glm/geometric.hpp>
#include <limits>

namespace nacre {
namespace {

constexpr std::size_t kWaist = 6;
constexpr std::size_t kMaxLoop = 12;
/// Of a triangle without area: worse than any other, yet possible.
constexpr double kWorst = 1e100;
constexpr double kNever = std::numeric_limits<double>::infinity();

template <std::size_t kExtra>
using Table = std::array<std::array<double, kWaist + kExtra>, kMaxLoop + kExtra>;

double badness(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const glm::dvec3 bc = c - b;
  const double area = glm::length(glm::cross(ab, ac));
  if (!(area > 0.0)) return kWorst;
  return (glm::dot(ab, ab) + glm::dot(ac, ac) + glm::dot(bc, bc)) / area;
}

/// The badness of the triangles that leave loop vertex i and waist vertex j: one step along the
/// loop, or one along the waist.
struct Steps {
  Table<0> along_loop;
  Table<0> along_waist;
};

Steps judge_steps(std::span<const glm::dvec3> loop, std::span<const glm::dvec3, kWaist> waist) {
  Steps steps{};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    for (std::size_t j = 0; j < kWaist; ++j) {
      steps.along_loop[i][j] = badness(loop[i], loop[(i + 1) % loop.size()], waist[j]);
      steps.along_waist[i][j] = badness(loop[i], waist[(j + 1) % kWaist], waist[j]);
    }
  }
  return steps;
}

/// Least badness after i steps along the loop and j along the waist, and the last step's kind.
struct Way {
  Table<1> cost{};
  std::array<std::array<bool, kWaist + 1>, kMaxLoop + 1> along_loop{};
};

/// The best way once round from loop vertex i0 and waist vertex j0 that begins with a step along
/// the loop and ends with one along the waist. Every way round has such a place to start from.
/// Only all steps along the loop before all along the waist would use a line twice.
Way best_way(const Steps& steps, std::size_t n, std::size_t i0, std::size_t j0) {
  Way way;
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t j = 0; j <= kWaist; ++j) {
      if (i == 0 && j == 0) continue;
      if (i == n && j == 0) {
        way.cost[i][j] = kNever;
        continue;
      }
      const double by_loop =
          i > 0 ? way.cost[i - 1][j] + steps.along_loop[(i0 + i - 1) % n][(j0 + j) % kWaist]
                : kNever;
      const double by_waist =
          i > 0 && j > 0
              ? way.cost[i][j - 1] + steps.along_waist[(i0 + i) % n][(j0 + j - 1) % kWaist]
              : kNever;
      way.along_loop[i][j] = by_loop <= by_waist && !(i == n && j == kWaist);
      way.cost[i][j] = way.along_loop[i][j] ? by_loop : by_waist;
    }
  }
  return way;
}

}  // namespace

std::vector<BandTriangle> tube_band(std::span<const glm::dvec3> loop,
                                    std::span<const glm::dvec3, 6> waist) {
  const std::size_t n = loop.size();
  assert(n > 0);
  const Steps steps = judge_steps(loop, waist);
  double least = kNever;
  Way best;
  std::size_t best_i0 = 0;
  std::size_t best_j0 = 0;
  for (std::size_t start = 0; start < n * kWaist; ++start) {
    const Way way = best_way(steps, n, start / kWaist, start % kWaist);
    if (!(way.cost[n][kWaist] < least)) continue;
    least = way.cost[n][kWaist];
    best = way;
    best_i0 = start / kWaist;
    best_j0 = start % kWaist;
  }
  const auto loop_vertex = [&](std::size_t i) {
    return static_cast<std::uint8_t>((best_i0 + i) % n);
  };
  const auto waist_vertex = [&](std::size_t j) {
    return static_cast<std::uint8_t>(n + (best_j0 + j) % kWaist);
  };
  std::vector<BandTriangle> band;
  band.reserve(n + kWaist);
  for (std::size_t i = n, j = kWaist; i > 0 || j > 0;) {
    if (best.along_loop[i][j]) {
      band.push_back({loop_vertex(i - 1), loop_vertex(i), waist_vertex(j)});
      --i;
    } else {
      band.push_back({loop_vertex(i), waist_vertex(j), waist_vertex(j - 1)});
      --j;
    }
  }
  return band;
}

}  // namespace nacre
