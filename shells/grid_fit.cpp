#include "shells/grid_fit.h"

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/quantization_grid.h"
#include "shells/grid_points.h"
#include "shells/star.h"

namespace nacre {
namespace {

constexpr int kNearby = 27;
// A second time over, vertices meet neighbours that are on the grid, too. That is worth its time
// where a step is large beside what the field shows, samples.
constexpr double kCoarseStep = 0.1;

/// The i-th of the grid points around one.
glm::ivec3 neighbour(const glm::ivec3& index, int i) {
  return index + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1;
}

/// The most samples that a step along one of the grid's axes crosses.
double step_samples(const QuantizationGrid& grid, const glm::dmat3& samples_from_mm) {
  double most = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    most = std::max(most, glm::length(samples_from_mm[axis]));
  }
  return most * step_mm(grid);
}

/// The best grid point around `here`, where `fit` has sampled the star.
glm::dvec3 best_point(const QuantizationGrid& grid, const Star& star, const StarFit& fit,
                      const glm::dvec3& here) {
  const glm::ivec3 nearest = nearest_index(grid, here);
  glm::dvec3 best(grid_position(grid, nearest));
  if (fit.is_pinned()) return best;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kNearby; ++i) {
    const glm::ivec3 index = neighbour(nearest, i);
    if (!is_in_grid(index, grid.bits)) continue;
    const glm::dvec3 p(grid_position(grid, index));
    const double change = fit.change(p - here);
    if (change >= least || !keeps_shape(star, p)) continue;
    least = change;
    best = p;
  }
  return best;
}

}  // namespace

void fit_to_grid(const ClosedMesh& mesh, const SurfaceField& field,
                 const glm::dmat3& samples_from_mm, const QuantizationGrid& grid,
                 std::span<glm::dvec3> positions, double volume_weight,
                 const BorderRounding* border) {
  Star star;
  StarFit fit(field, samples_from_mm, volume_weight);
  std::vector<double> allowed;
  // These wait in their planes, so that what the others are fitted to is within the volume.
  const auto is_on_border = [&](std::uint32_t v) {
    return border != nullptr && border->is_on_border(positions[v]);
  };
  const int rounds = step_samples(grid, samples_from_mm) > kCoarseStep ? 2 : 1;
  for (int round = 0; round < rounds; ++round) {
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
      if (mesh.outgoing(v) == ClosedMesh::kNone || is_on_border(v)) continue;
      star_of_vertex(mesh, positions, v, star);
      allowed.assign(star.triangles.size(), std::numeric_limits<double>::infinity());
      fit.sample(star, positions[v], allowed);
      positions[v] = best_point(grid, star, fit, positions[v]);
    }
  }
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    if (is_on_border(v)) positions[v] = grid_position(grid, border->index(positions[v]));
  }
}

}  // namespace nacre
