#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "extract/cell_row.h"
#include "extract/cell_topology.h"
#include "extract/corner_field.h"
#include "extract/level_output.h"
#include "extract/sample_reader.h"
#include "extract/sweep_grid.h"

namespace nacre {

/// Last passes of the sweep: the triangles of all levels in a layer of cells, and those of the caps
/// where it lies at the volume's border. Counter-clockwise in a right-handed lattice.
class CellContours {
 public:
  /// @param crossings   stored value of each level, see `StoredLevels`
  /// @param descending  inside is where stored samples are small
  CellContours(const SweepGrid& grid, const SampleReader& samples,
               std::span<const double> crossings, bool descending)
      : grid_(grid), samples_(samples), crossings_(crossings), descending_(descending) {}

  /// @param row  the layer's first row
  void add_layer(CellRow row, SlabOutput& output) const;

 private:
  struct Cell;

  void add_row(const CellRow& row, SlabOutput& output) const;
  void add_caps(const CellRow& row, SlabOutput& output) const;

  void add_cell(const CellRow& row, std::size_t x, std::size_t lo, std::size_t hi,
                SlabOutput& output) const;
  void add_ambiguous(const Cell& cell, const CornerField& values, SlabOutput& output) const;
  void add_disc(const Cell& cell, const CornerField& field, const CellLoop& loop,
                SlabOutput& output) const;
  void add_tube(const Cell& cell, const CornerField& field, const CellCase& resolved,
                const Tunnel& tunnel, SlabOutput& output) const;
  void add_cap(const CellRow& row, std::size_t x, std::size_t face, SlabOutput& output) const;

  CornerField half_samples(const CellRow& row, std::size_t x) const;
  /// Positive inside level k; halved, too.
  CornerField field(const CornerField& halves, std::size_t k) const;
  std::uint32_t add_inner_vertex(const Cell& cell, const glm::dvec3& p_cell,
                                 SlabOutput& output) const;

  const SweepGrid& grid_;
  const SampleReader& samples_;
  std::span<const double> crossings_;
  bool descending_;
  const CellTopology& topology_ = CellTopology::instance();
};

}  // namespace nacre
