#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "extract/cell_topology.h"
#include "extract/marching_cubes.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/test_volumes.h"

namespace nacre {
namespace {

// Cells compared; with a hundred times as many the result is the same.
constexpr int kCells = 150;

using Corners = std::array<double, 8>;

double trilinear(const Corners& f, double x, double y, double z) {
  const auto mix = [](double a, double b, double t) { return a * (1.0 - t) + b * t; };
  return mix(mix(mix(f[0], f[1], x), mix(f[2], f[3], x), y),
             mix(mix(f[4], f[5], x), mix(f[6], f[7], x), y), z);
}

/// How the inside of a trilinear cell hangs together.
struct Topology {
  long components = 0;
  long euler_number = 0;  ///< of the solid
  bool operator==(const Topology&) const = default;
};

/// The cell sampled at (n + 1)^3 points; inside points are joined along lattice edges, and squares
/// and cubes of inside points are filled.
class SampledCell {
 public:
  SampledCell(const Corners& corners, int n) : n_(n + 1), inside_(cube(n_)) {
    for (int z = 0; z < n_; ++z) {
      for (int y = 0; y < n_; ++y) {
        for (int x = 0; x < n_; ++x) {
          inside_[index(x, y, z)] =
              trilinear(corners, static_cast<double>(x) / n, static_cast<double>(y) / n,
                        static_cast<double>(z) / n) >= 0.0;
        }
      }
    }
  }

  Topology topology() const {
    Topology result;
    parents_.resize(inside_.size());
    std::iota(parents_.begin(), parents_.end(), std::size_t{0});
    for (int z = 0; z < n_; ++z) {
      for (int y = 0; y < n_; ++y) {
        for (int x = 0; x < n_; ++x) add_faces_from(x, y, z, result);
      }
    }
    for (std::size_t i = 0; i < parents_.size(); ++i) {
      if (inside_[i] && parents_[i] == i) ++result.components;
    }
    return result;
  }

 private:
  static std::size_t cube(int n) {
    const auto side = static_cast<std::size_t>(n);
    return side * side * side;
  }
  std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>(x + n_ * (y + n_ * z));
  }
  std::size_t root(std::size_t i) const {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }

  /// Counts the point, edges, squares and cube that begin at a point, with alternating sign.
  void add_faces_from(int x, int y, int z, Topology& result) const {
    for (int extent = 0; extent < 8; ++extent) {
      bool all_inside = true;
      for (int corner = 0; corner < 8 && all_inside; ++corner) {
        if ((corner & ~extent) != 0) continue;
        const int cx = x + (corner & 1);
        const int cy = y + (corner >> 1 & 1);
        const int cz = z + (corner >> 2);
        all_inside = cx < n_ && cy < n_ && cz < n_ && inside_[index(cx, cy, cz)];
      }
      if (!all_inside) continue;
      const int dimension = (extent & 1) + (extent >> 1 & 1) + (extent >> 2);
      result.euler_number += dimension % 2 == 0 ? 1 : -1;
      if (dimension != 1) continue;
      const std::size_t end = index(x + (extent & 1), y + (extent >> 1 & 1), z + (extent >> 2));
      parents_[root(end)] = root(index(x, y, z));
    }
  }

  int n_;
  std::vector<bool> inside_;
  mutable std::vector<std::size_t> parents_;
};

/// The sampled topology, where two resolutions agree on it: else a saddle is too near the level for
/// either to tell.
std::optional<Topology> sampled_topology(const Corners& corners) {
  const Topology coarse = SampledCell(corners, 17).topology();
  const Topology fine = SampledCell(corners, 26).topology();
  if (coarse != fine) return std::nullopt;
  return fine;
}

Topology extracted_topology(const Corners& corners) {
  const Volume volume = testing::volume_of<double>({2, 2, 2}, [&](auto x, auto y, auto z) {
    return corners[static_cast<std::size_t>(x + 2 * y + 4 * z)];
  });
  const std::array<double, 1> level{0.0};
  const testing::MeshFacts facts = testing::facts_of(extract_surfaces(volume, level)[0]);
  // The capped surface bounds the solid: its Euler number is twice the solid's.
  return {static_cast<long>(facts.components), facts.euler_number() / 2};
}

TEST(CellTopology, IsThatOfTheTrilinearField) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int compared = 0;
  int wrong = 0;
  while (compared < kCells) {
    Corners corners{};
    unsigned mask = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      corners[i] = unit(random);
      mask |= (corners[i] >= 0.0 ? 1u : 0u) << i;
    }
    if (CellTopology::instance().simple(mask).triangle_count != SimpleCase::kNotSimple) continue;
    const std::optional<Topology> sampled = sampled_topology(corners);
    if (!sampled) continue;
    ++compared;
    const Topology extracted = extracted_topology(corners);
    // A thin neck can pass between the points of both lattices.
    if (extracted == *sampled || extracted == SampledCell(corners, 150).topology()) continue;
    ++wrong;
    ADD_FAILURE() << "mask " << mask << ": " << extracted.components << " parts, Euler number "
                  << extracted.euler_number << "; sampled " << sampled->components << ", "
                  << sampled->euler_number;
  }
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace nacre
