#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "extract/cell_topology.h"
#include "extract/lattice_slice.h"
#include "extract/sweep_grid.h"

namespace nacre {

/// A row of cells (., y, z) between two classified slices: classes of its four rows of samples, and
/// the vertices on its cells' edges and border corners. Starts at y = 0.
class CellRow {
 public:
  CellRow(const SweepGrid& grid, std::size_t z, const LatticeSlice& lower,
          const LatticeSlice& upper, const LatticeGap& gap, const VertexIds& ids);

  /// On to the next y.
  void advance();

  std::size_t y() const { return y_; }
  std::size_t z() const { return z_; }

  /// The classes of cell x's corners, corner i in byte i.
  std::uint64_t corner_classes(std::size_t x) const {
    std::uint64_t packed = 0;
    for (std::size_t row = 0; row < 4; ++row) {
      std::uint16_t pair = 0;
      std::memcpy(&pair, classes_[row] + x, 2);
      packed |= std::uint64_t{pair} << (16 * row);
    }
    return packed;
  }

  /// Vertex of level k on an edge of cell x.
  std::uint32_t edge_vertex(std::size_t edge, std::size_t x, std::size_t k) const {
    return ids_[static_cast<std::uint32_t>(edges_[edge][x] + k)];
  }

  /// Vertex of level k at a corner of cell x on the volume's border.
  std::uint32_t corner_vertex(std::size_t corner, std::size_t x, std::size_t k) const {
    return ids_[static_cast<std::uint32_t>(corners_[corner][x] + k)];
  }

  /// The joint class range of the row's four bricks.
  ClassRange brick_range(std::size_t brick) const {
    ClassRange range = bricks_[0][brick];
    for (std::size_t row = 1; row < 4; ++row) {
      range.lo = std::min(range.lo, bricks_[row][brick].lo);
      range.hi = std::max(range.hi, bricks_[row][brick].hi);
    }
    return range;
  }

  /// The class range of each cell of a brick. Writes whole bricks, also where the row ends.
  void cell_ranges(std::size_t brick, std::uint8_t* lo, std::uint8_t* hi) const;

 private:
  std::size_t nx_;
  std::size_t y_ = 0;
  std::size_t z_;
  std::array<const std::uint8_t*, 4> classes_{};  ///< of the rows y z, y+1 z, y z+1, y+1 z+1
  std::array<const ClassRange*, 4> bricks_{};
  std::array<const std::uint32_t*, kCellEdges> edges_{};  ///< handles of vertices, by x
  std::array<const std::uint32_t*, kCellCorners> corners_{};
  const std::uint32_t* ids_;
};

}  // namespace nacre
