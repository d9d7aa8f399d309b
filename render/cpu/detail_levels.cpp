#include "render/cpu/detail_levels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
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

/// The mean of the positions that share a number.
std::vector<glm::vec3> means(const std::vector<glm::vec3>& positions,
                             const std::vector<std::uint32_t>& numbers) {
  std::vector<glm::dvec4> sums;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (numbers[i] == sums.size()) sums.emplace_back(0.0);
    sums[numbers[i]] += glm::dvec4(positions[i], 1.0);
  }
  std::vector<glm::vec3> result;
  result.reserve(sums.size());
  for (const glm::dvec4& sum : sums) result.emplace_back(glm::dvec3(sum) / sum.w);
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
  result.mesh.positions = means(mesh.positions, numbers);
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
