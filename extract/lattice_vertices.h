#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "extract/lattice_slice.h"
#include "extract/level_output.h"
#include "extract/sample_classes.h"
#include "extract/stored_levels.h"
#include "extract/sweep_grid.h"

namespace nacre {

/// Who writes the positions of the vertices that are numbered.
enum class Ownership { Own, Shared };

/// First passes of the sweep: classes, and a vertex wherever a level crosses a lattice edge.
///
/// On an edge from sample a to sample b, level v has its vertex at
///
///     t = (v - a) / (b - a),    clamped to [margin, 1 - margin],
///
/// in double. The margin keeps vertices off the samples, so that a sample equal to a level makes no
/// two vertices coincide and no triangle vanish.
///
/// The vertices of a slice are numbered in one fixed order, whoever asks.
template <class T>
class LatticeVertices {
 public:
  LatticeVertices(const SweepGrid& grid, const StoredLevels<T>& levels,
                  const SampleClasses<T>& classes, std::span<const T> samples)
      : grid_(grid), levels_(levels), classes_(classes), samples_(samples) {}

  /// Fills the slice's classes and brick ranges.
  void classify(std::size_t z, LatticeSlice& slice) const;

  /// Adds the vertices on the slice's x and y edges and, on the volume's border, one vertex per
  /// sample and level it is inside of: the corners of the caps.
  void add_in_slice(std::size_t z, LatticeSlice& slice, VertexIds& ids, SlabOutput& output,
                    Ownership ownership) const;

  /// Adds the vertices on the z edges between slices z and z + 1.
  void add_between(std::size_t z, const LatticeSlice& lower, const LatticeSlice& upper,
                   LatticeGap& gap, VertexIds& ids, SlabOutput& output) const;

 private:
  struct Edge;

  void add_edge(const Edge& edge, VertexIds& ids, std::uint32_t& handle, SlabOutput& output,
                Ownership ownership) const;
  void add_row(std::size_t y, std::size_t z, LatticeSlice& slice, VertexIds& ids,
               SlabOutput& output, Ownership ownership) const;
  void add_corner(std::size_t x, std::size_t y, std::size_t z, LatticeSlice& slice, VertexIds& ids,
                  SlabOutput& output, Ownership ownership) const;
  void add_border_corners(std::size_t y, std::size_t z, LatticeSlice& slice, VertexIds& ids,
                          SlabOutput& output, Ownership ownership) const;
  glm::dvec3 position(std::size_t x, std::size_t y, std::size_t z) const {
    return grid_.position_mm(glm::dvec3(x, y, z));
  }

  const SweepGrid& grid_;
  const StoredLevels<T>& levels_;
  const SampleClasses<T>& classes_;
  std::span<const T> samples_;
};

}  // namespace nacre
