#include "shells/prune.h"

#include <tbb/parallel_for.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shells/components.h"

namespace nacre {
namespace {

void add(ComponentCount& count, const Component& component) {
  ++count.components;
  count.triangles += component.triangles;
  count.volume_mm3 += std::abs(component.volume_mm3);
}

void add(ComponentCount& count, const ComponentCount& other) {
  count.components += other.components;
  count.triangles += other.triangles;
  count.volume_mm3 += other.volume_mm3;
}

/// The triangles of the components that stay, and their vertices.
TriangleMesh kept_part(const TriangleMesh& mesh, const Components& components,
                       const std::vector<bool>& gone) {
  std::vector<bool> used(mesh.positions.size(), false);
  TriangleMesh kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (gone[components.of_triangle[t]]) continue;
    kept.triangles.push_back(mesh.triangles[t]);
    for (int i = 0; i < 3; ++i) used[mesh.triangles[t][i]] = true;
  }
  std::vector<std::uint32_t> number(mesh.positions.size(), 0);
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    number[v] = static_cast<std::uint32_t>(kept.positions.size());
    kept.positions.push_back(mesh.positions[v]);
  }
  for (glm::uvec3& t : kept.triangles) t = {number[t.x], number[t.y], number[t.z]};
  return kept;
}

}  // namespace

double default_speck_mm3(const glm::dmat4& world_from_voxel) {
  constexpr double kSpeckVoxels = 1.0 / 64.0;
  return kSpeckVoxels * std::abs(glm::determinant(glm::dmat3(world_from_voxel)));
}

/// Finds the lost islands of one shell around a point.
class Pruner::LostIslands {
 public:
  explicit LostIslands(std::vector<LostIsland> islands) : islands_(std::move(islands)) {
    std::sort(islands_.begin(), islands_.end(),
              [](const LostIsland& a, const LostIsland& b) { return a.lo.x < b.lo.x; });
    for (const LostIsland& island : islands_)
      widest_ = std::max(widest_, island.hi.x - island.lo.x);
  }

  /// The least that is shown at a point where it may be in a lost island; `otherwise` elsewhere.
  double shown_at(const glm::vec3& p, double otherwise) const {
    auto island =
        std::lower_bound(islands_.begin(), islands_.end(), p.x - widest_,
                         [](const LostIsland& candidate, float x) { return candidate.lo.x < x; });
    double shown = otherwise;
    for (; island != islands_.end() && island->lo.x <= p.x; ++island) {
      const bool inside = p.x <= island->hi.x && p.y >= island->lo.y && p.y <= island->hi.y &&
                          p.z >= island->lo.z && p.z <= island->hi.z;
      if (inside) shown = std::min(shown, island->shown);
    }
    return shown;
  }

 private:
  std::vector<LostIsland> islands_;
  float widest_ = 0.0F;
};

Pruner::Pruner(std::size_t shells, const PruneOptions& options)
    : options_(options), shells_(shells) {}

TriangleMesh Pruner::prune(std::size_t k, TriangleMesh&& surface) {
  TriangleMesh mesh = std::move(surface);
  if (options_.min_component_mm3 <= 0.0 && !options_.prune_inner) return mesh;
  ShellPruning& pruning = shells_[k];
  const Components components = find_components(mesh);
  const std::vector<bool> inner = options_.prune_inner ? inner_components(mesh, components)
                                                       : std::vector<bool>(components.list.size());
  std::vector<bool> gone(components.list.size(), false);
  for (std::size_t i = 0; i < gone.size(); ++i) {
    const Component& component = components.list[i];
    gone[i] = inner[i] || std::abs(component.volume_mm3) < options_.min_component_mm3;
    if (!gone[i]) continue;
    add(inner[i] ? pruning.inner : pruning.specks, component);
    if (!inner[i] && component.volume_mm3 > 0.0) {
      pruning.islands.push_back({component.lo, component.hi, 0.0});
    }
  }
  if (std::find(gone.begin(), gone.end(), true) == gone.end()) return mesh;
  return kept_part(mesh, components, gone);
}

/// From the outermost shell inwards: an island in a lost island shows what that one shows, another
/// the layer of the shell around it.
double Pruner::largest_loss(const ShellSet& set) const {
  double largest = 0.0;
  LostIslands outer({});
  for (std::size_t k = 0; k < shells_.size(); ++k) {
    const double layer = k > 0 ? set.shells[k - 1].representative : 0.0;
    std::vector<LostIsland> islands = shells_[k].islands;
    for (LostIsland& island : islands) {
      island.shown = outer.shown_at(0.5F * (island.lo + island.hi), layer);
      largest = std::max(largest, set.shells[k].representative - island.shown);
    }
    outer = LostIslands(std::move(islands));
  }
  return largest;
}

Pruning Pruner::result(const ShellSet& set) const {
  Pruning pruning;
  pruning.min_component_mm3 = options_.min_component_mm3;
  pruning.inner_pruned = options_.prune_inner;
  for (const ShellPruning& shell : shells_) {
    add(pruning.specks, shell.specks);
    add(pruning.inner, shell.inner);
  }
  pruning.largest_emission = largest_loss(set);
  return pruning;
}

Pruning prune(ShellSet& set, const PruneOptions& options) {
  Pruner pruner(set.shells.size(), options);
  tbb::parallel_for(std::size_t{0}, set.shells.size(), [&](std::size_t k) {
    set.shells[k].surface = pruner.prune(k, std::move(set.shells[k].surface));
  });
  return pruner.result(set);
}

}  // namespace nacre
