#include "render/cpu/detail_levels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <utility>

namespace nacre {
namespace {

/// Numbers distinct keys in the order in which they come: a table with linear probing.
class KeyNumbers {
 public:
  explicit KeyNumbers(std::size_t keys)
      : slots_(std::bit_ceil(2 * keys + 1)), mask_(slots_.size() - 1) {}

  std::uint32_t number(std::uint64_t key) {
    // Fibonacci hashing: neighbouring cells go far apart.
    std::size_t place = (key * 0x9E3779B97F4A7C15U >> 20U) & mask_;
    while (slots_[place].number != kFree && slots_[place].key != key) place = (place + 1) & mask_;
    if (slots_[place].number == kFree) slots_[place] = {key, count_++};
    return slots_[place].number;
  }

 private:
  static constexpr std::uint32_t kFree = 0xFFFFFFFFU;

  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t number = kFree;
  };

  std::vector<Slot> slots_;
  std::size_t mask_;
  std::uint32_t count_ = 0;
};

/// The squared distance from planes, weighed, as a quadric x'Ax - 2b'x + c (Garland, Heckbert 1997,
/// "Surface Simplification Using Quadric Error Metrics"), and the mean of some points.
struct CellSum {
  glm::dmat3 normals{0.0};  ///< A
  glm::dvec3 planes{0.0};   ///< b
  glm::dvec3 points{0.0};
  double count = 0.0;
};

/// How much the mean counts against the planes: enough to choose a point on a plane or an edge.
constexpr double kMeanWeight = 1e-2;

/// The point nearest to the planes of a cell; the mean of its points where that is far from them.
/// All relative to the first of the points.
glm::dvec3 best_point(const CellSum& sum, double cell_mm) {
  const glm::dvec3 mean = sum.points / sum.count;
  const double weight = kMeanWeight * (sum.normals[0][0] + sum.normals[1][1] + sum.normals[2][2]);
  if (!(weight > 0.0)) return mean;
  const glm::dvec3 best =
      glm::inverse(sum.normals + glm::dmat3(weight)) * (sum.planes + weight * mean);
  return glm::distance(best, mean) <= 0.5 * cell_mm ? best : mean;
}

/// A position for each number: where the triangles around the vertices of that number are kept best
/// (Lindstrom 2000, "Out-of-core simplification of large polygonal models").
std::vector<glm::vec3> merged_positions(const TriangleMesh& mesh,
                                        const std::vector<std::uint32_t>& numbers, double cell_mm) {
  std::vector<glm::dvec3> first;
  std::vector<CellSum> sums;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] == sums.size()) {
      first.emplace_back(mesh.positions[i]);
      sums.emplace_back();
    }
    sums[numbers[i]].points += glm::dvec3(mesh.positions[i]) - first[numbers[i]];
    sums[numbers[i]].count += 1.0;
  }
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]);
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
    for (int corner = 0; corner < 3; ++corner) {
      CellSum& sum = sums[numbers[t[corner]]];
      sum.normals += glm::outerProduct(normal, normal);
      sum.planes += glm::dot(normal, a - first[numbers[t[corner]]]) * normal;
    }
  }
  std::vector<glm::vec3> result;
  result.reserve(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    result.emplace_back(first[i] + best_point(sums[i], cell_mm));
  }
  return result;
}

/// How far vertices went at most, and with them, as triangles are flat, all points of the surface.
double farthest_mm(const TriangleMesh& mesh, const TriangleMesh& coarse,
                   const std::vector<std::uint32_t>& merged_to) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < merged_to.size(); ++i) {
    farthest = std::max<double>(farthest,
                                glm::distance(mesh.positions[i], coarse.positions[merged_to[i]]));
  }
  return farthest;
}

}  // namespace

MergedVertices merge_vertices(const TriangleMesh& mesh, double cell_mm) {
  glm::vec3 lo = mesh.positions.empty() ? glm::vec3(0.0F) : mesh.positions.front();
  for (const glm::vec3& p : mesh.positions) lo = glm::min(lo, p);
  constexpr double kMostCells = (1 << 21) - 1;  // a side: 21 bits each of a key
  const auto key = [&](const glm::vec3& p) {
    const glm::dvec3 cell = glm::min((glm::dvec3(p) - glm::dvec3(lo)) / cell_mm, kMostCells);
    return static_cast<std::uint64_t>(cell.x) | static_cast<std::uint64_t>(cell.y) << 21U |
           static_cast<std::uint64_t>(cell.z) << 42U;
  };
  KeyNumbers cells(mesh.positions.size());
  std::vector<std::uint32_t> numbers;
  numbers.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions) numbers.push_back(cells.number(key(p)));

  MergedVertices result;
  result.mesh.positions = merged_positions(mesh, numbers, cell_mm);
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::uvec3 merged(numbers[t.x], numbers[t.y], numbers[t.z]);
    if (merged.x != merged.y && merged.y != merged.z && merged.z != merged.x) {
      result.mesh.triangles.push_back(merged);
    }
  }
  result.merged_to = std::move(numbers);
  return result;
}

std::vector<DetailLevel> detail_levels(const TriangleMesh& mesh, std::size_t least_triangles) {
  std::vector<DetailLevel> levels;
  levels.push_back({cluster_mesh(mesh), 0.0});
  if (mesh.triangles.size() <= least_triangles) return levels;
  TriangleMesh coarse = mesh;
  std::vector<std::uint32_t> merged_to(mesh.positions.size());
  std::iota(merged_to.begin(), merged_to.end(), 0U);
  for (double cell_mm = mean_edge_mm(mesh); coarse.triangles.size() > least_triangles;
       cell_mm *= 2.0) {
    MergedVertices merged = merge_vertices(coarse, cell_mm);
    for (std::uint32_t& vertex : merged_to) vertex = merged.merged_to[vertex];
    const bool similar = 10 * merged.mesh.triangles.size() > 7 * coarse.triangles.size();
    coarse = std::move(merged.mesh);
    if (similar) continue;
    levels.push_back({cluster_mesh(coarse), farthest_mm(mesh, coarse, merged_to)});
  }
  return levels;
}

}  // namespace nacre
