#include "render/cpu/detail_levels.h"

#include <numbers>

#include "render/cpu/edge_merging.h"

namespace nacre {
namespace {

/// How far vertices may go first, in mean edges: the shortest edges only are merged.
constexpr double kFirstReach = 0.7;

/// Steps of twice the area each: ten million triangles become few.
constexpr int kSteps = 24;

}  // namespace

std::vector<DetailLevel> detail_levels(const TriangleMesh& mesh, std::size_t least_triangles,
                                       double most_mm) {
  std::vector<DetailLevel> levels;
  levels.push_back({cluster_mesh(mesh, most_mm), 0.0});
  if (mesh.triangles.size() <= least_triangles) return levels;
  EdgeMerging merging(mesh);
  double reach_mm = kFirstReach * mean_edge_mm(mesh);
  for (int i = 0; i < kSteps && merging.mesh().triangles.size() > least_triangles; ++i) {
    merging.merge_pairs(reach_mm);
    reach_mm *= std::numbers::sqrt2;
    if (10 * merging.mesh().triangles.size() > 7 * levels.back().mesh.triangles) continue;
    levels.push_back({cluster_mesh(merging.mesh(), most_mm), merging.farthest_mm()});
  }
  return levels;
}

}  // namespace nacre
