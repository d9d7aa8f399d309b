#include "extract/cell_row.h"

#include <algorithm>

namespace nacre {

CellRow::CellRow(const SweepGrid& grid, std::size_t z, const LatticeSlice& lower,
                 const LatticeSlice& upper, const LatticeGap& gap, const VertexIds& ids)
    : nx_(grid.dims[0]), z_(z), ids_(ids.data()) {
  const std::array<const LatticeSlice*, 2> slices{&lower, &upper};
  for (std::size_t row = 0; row < 4; ++row) {
    classes_[row] = slices[row >> 1]->classes.data() + nx_ * (row & 1);
    bricks_[row] = slices[row >> 1]->bricks.data() + brick_count(nx_) * (row & 1);
  }
  for (std::size_t edge = 0; edge < kCellEdges; ++edge) {
    const std::size_t corner = kEdgesOfCell[edge][0];  // the end that names a lattice edge
    const LatticeSlice& slice = *slices[corner >> 2];
    const std::size_t offset = (corner & 1) + nx_ * (corner >> 1 & 1);
    switch (edge / 4) {
      case 0: edges_[edge] = slice.x_edges.get() + offset; break;
      case 1: edges_[edge] = slice.y_edges.get() + offset; break;
      default: edges_[edge] = gap.z_edges.get() + offset; break;
    }
  }
  for (std::size_t corner = 0; corner < kCellCorners; ++corner) {
    const LatticeSlice& slice = *slices[corner >> 2];
    const std::size_t offset = (corner & 1) + nx_ * (corner >> 1 & 1);
    corners_[corner] = slice.corners.get() + offset;
  }
}

void CellRow::advance() {
  ++y_;
  for (const std::uint8_t*& classes : classes_) classes += nx_;
  for (const ClassRange*& bricks : bricks_) bricks += brick_count(nx_);
  for (const std::uint32_t*& handles : edges_) handles += nx_;
  for (const std::uint32_t*& handles : corners_) handles += nx_;
}

void CellRow::cell_ranges(std::size_t brick, std::uint8_t* lo, std::uint8_t* hi) const {
  const std::size_t begin = brick * kBrickCells;
  std::array<std::uint8_t, kBrickCells + 1> column_lo;
  std::array<std::uint8_t, kBrickCells + 1> column_hi;
  for (std::size_t i = 0; i <= kBrickCells; ++i) {
    const std::uint8_t a = classes_[0][begin + i];
    const std::uint8_t b = classes_[1][begin + i];
    const std::uint8_t c = classes_[2][begin + i];
    const std::uint8_t d = classes_[3][begin + i];
    column_lo[i] = std::min(std::min(a, b), std::min(c, d));
    column_hi[i] = std::max(std::max(a, b), std::max(c, d));
  }
  for (std::size_t i = 0; i < kBrickCells; ++i) {
    lo[i] = std::min(column_lo[i], column_lo[i + 1]);
    hi[i] = std::max(column_hi[i], column_hi[i + 1]);
  }
}

}  // namespace nacre
