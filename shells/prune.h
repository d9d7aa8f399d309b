#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/shell_set.h"

namespace nacre {

struct PruneOptions {
  /// Components of less volume, with either sign, are specks; 0 keeps them.
  double min_component_mm3 = 0.0;
  /// Leaves out components inside an outer surface of their own shell: cavities, and what lies
  /// within them.
  bool prune_inner = false;
};

/// The volume below which `nacre build` takes a component for a speck: a 64th of a voxel. Less is
/// one sample that reaches its level and less than a quarter of the way to its neighbours.
double default_speck_mm3(const glm::dmat4& world_from_voxel);

/// Leaves closed components out of the surfaces of a set, which come one by one.
///
/// *Specks* are islands, and cavities, of less volume than a bound. A ray through a speck of shell
/// k loses r_k down to what the shells around it show, if it meets nothing as bright elsewhere: the
/// largest such loss is reported. Cavities of that size are filled, which a maximum projection
/// does not show.
///
/// *Inner components*: a ray from outside that meets a component inside a closed surface of the
/// same shell meets that surface, too, nearer and farther. So no maximum projection shows it that
/// starts outside the volume and has no slab; sums, counts, slabs and eyes within the volume do.
///
/// What is left is closed, oriented and manifold as before; vertices and triangles keep their
/// order.
class Pruner {
 public:
  Pruner(std::size_t shells, const PruneOptions& options);

  /// Shell `k` without what is to be left out. For each shell once; safe from several threads.
  /// @param surface  closed
  /// O(triangles); inner components cost a search of one column of triangles each.
  TriangleMesh prune(std::size_t k, TriangleMesh&& surface);

  /// What was left out of all shells.
  /// @param set  its representatives; shells nested as level sets are
  Pruning result(const ShellSet& set) const;

 private:
  /// An island that was left out.
  struct LostIsland {
    glm::vec3 lo;
    glm::vec3 hi;
    double shown;  ///< what the shells around it still show in its place
  };
  class LostIslands;

  struct ShellPruning {
    ComponentCount specks;
    ComponentCount inner;
    std::vector<LostIsland> islands;
  };

  double largest_loss(const ShellSet& set) const;

  PruneOptions options_;
  std::vector<ShellPruning> shells_;
};

/// The same for all surfaces of a set in memory.
Pruning prune(ShellSet& set, const PruneOptions& options);

}  // namespace nacre
