#include "extract/slab_sweep.h"

#include <limits>
#include <utility>

#include "core/error.h"
#include "extract/cell_row.h"

namespace nacre {
namespace {

/// Numbers within a slab have 32 bits; they wrapped without harm until here.
void check_numbers(const SlabOutput& output, const SweepWorkspace& workspace) {
  constexpr std::uint64_t kLargest = std::numeric_limits<std::uint32_t>::max();
  std::uint64_t largest = workspace.ids.size();
  for (const LevelOutput& level : output.levels) largest = std::max(largest, level.next_vertex);
  if (largest > kLargest) {
    throw Error(ErrorCode::Unsupported,
                "surfaces: found more than 2^32 - 1 vertices in one slab of the volume");
  }
}

void begin_slab(SlabOutput& output, Ownership ownership) {
  for (LevelOutput& level : output.levels) {
    level.shared_count = ownership == Ownership::Shared ? level.next_vertex : 0;
  }
}

}  // namespace

template <class T>
void sweep_slab(const Slab& slab, const LatticeVertices<T>& vertices, const CellContours& contours,
                const SweepGrid& grid, SweepWorkspace& workspace, SlabOutput& output) {
  auto& [lower, upper, gap, ids] = workspace;
  const Ownership ownership = slab.begin == 0 ? Ownership::Own : Ownership::Shared;
  ids.clear();
  vertices.classify(slab.begin, upper);
  vertices.add_in_slice(slab.begin, upper, ids, output, ownership);
  begin_slab(output, ownership);

  for (std::size_t z = slab.begin; z < slab.end; ++z) {
    std::swap(lower, upper);
    vertices.classify(z + 1, upper);
    vertices.add_between(z, lower, upper, gap, ids, output);
    for (LevelOutput& level : output.levels) level.top_begin = level.next_vertex;
    vertices.add_in_slice(z + 1, upper, ids, output, Ownership::Own);
    check_numbers(output, workspace);
    contours.add_layer(CellRow(grid, z, lower, upper, gap, ids), output);
  }
}

template void sweep_slab(const Slab&, const LatticeVertices<std::uint8_t>&, const CellContours&,
                         const SweepGrid&, SweepWorkspace&, SlabOutput&);
template void sweep_slab(const Slab&, const LatticeVertices<std::int8_t>&, const CellContours&,
                         const SweepGrid&, SweepWorkspace&, SlabOutput&);
template void sweep_slab(const Slab&, const LatticeVertices<std::uint16_t>&, const CellContours&,
                         const SweepGrid&, SweepWorkspace&, SlabOutput&);
template void sweep_slab(const Slab&, const LatticeVertices<std::int16_t>&, const CellContours&,
                         const SweepGrid&, SweepWorkspace&, SlabOutput&);
template void sweep_slab(const Slab&, const LatticeVertices<std::uint32_t>&, const CellContours&,
                         const SweepGrid&, SweepWorkspace&, SlabOutput&);
template void sweep_slab(const Slab&, const LatticeVertices<std::int32_t>&, const CellContours&,
                         const SweepGrid&, SweepWorkspace&, SlabOutput&);
template void sweep_slab(const Slab&, const LatticeVertices<float>&, const CellContours&,
                         const SweepGrid&, SweepWorkspace&, SlabOutput&);
template void sweep_slab(const Slab&, const LatticeVertices<double>&, const CellContours&,
                         const SweepGrid&, SweepWorkspace&, SlabOutput&);

}  // namespace nacre
