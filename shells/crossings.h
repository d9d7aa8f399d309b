#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/shell_set.h"

namespace nacre {

class GridSurface;

/// How a shell and the next that is not empty meet.
struct NeighbourCrossings {
  std::size_t outer = 0;  ///< index of the shell
  std::size_t inner = 0;  ///< index of the next
  std::size_t pairs = 0;  ///< of triangles that cross: each has corners on both sides of the other
};

/// Counts where neighbouring shells cross, exactly: positions are grid points, predicates integers.
/// Caps in the volume's border planes are left out: they lie on each other.
///
/// Plain code without CGAL, cheap enough for every build; `mutual_intersections` is its independent
/// check. Holds two surfaces at a time, 18 bytes a triangle.
class CrossingCounter {
 public:
  /// @param set  its grid and its volume; its surfaces are not looked at
  explicit CrossingCounter(const ShellSet& set);
  ~CrossingCounter();
  CrossingCounter(const CrossingCounter&) = delete;
  CrossingCounter& operator=(const CrossingCounter&) = delete;

  /// Takes the next shell that is not empty, from the outermost inwards.
  /// @param surface  on the grid
  void add(std::size_t shell, const TriangleMesh& surface);

  const std::vector<NeighbourCrossings>& result() const noexcept { return result_; }

 private:
  const ShellSet& set_;
  std::unique_ptr<const GridSurface> outer_;
  std::size_t outer_shell_ = 0;
  std::vector<NeighbourCrossings> result_;
};

}  // namespace nacre
