#include "extract/lattice_vertices.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace nacre {
namespace {

/// (level - a) / (b - a) for a level between the unequal samples a and b.
template <class T>
double crossing(double level, double a, double b) {
  const double width = b - a;
  if constexpr (std::is_same_v<T, double>) {
    if (!std::isfinite(width)) return (0.5 * level - 0.5 * a) / (0.5 * b - 0.5 * a);
  }
  return (level - a) / width;
}

}  // namespace

/// A crossed lattice edge, lower end first.
template <class T>
struct LatticeVertices<T>::Edge {
  std::uint8_t class_a;
  std::uint8_t class_b;
  T a;
  T b;
  std::size_t axis;
  glm::dvec3 start_mm;
};

template <class T>
void LatticeVertices<T>::classify(std::size_t z, LatticeSlice& slice) const {
  const std::size_t nx = grid_.dims[0];
  for (std::size_t y = 0; y < grid_.dims[1]; ++y) {
    std::uint8_t* classes = slice.classes.data() + nx * y;
    ClassRange* bricks = slice.bricks.data() + brick_count(nx) * y;
    const std::size_t first = grid_.sample_index(0, y, z);
    if (grid_.strides[0] == 0) {
      classes[0] = classes[1] = classes_.of(samples_[first]);
      bricks[0] = {classes[0], classes[0]};
    } else {
      classes_.of_row(samples_.subspan(first, nx), classes, bricks);
    }
  }
}

template <class T>
void LatticeVertices<T>::add_edge(const Edge& edge, VertexIds& ids, std::uint32_t& handle,
                                  SlabOutput& output, Ownership ownership) const {
  const std::size_t lo = std::min(edge.class_a, edge.class_b);
  const std::size_t hi = std::max(edge.class_a, edge.class_b);
  std::uint32_t* added = ids.add(lo, hi, handle);
  if (ownership == Ownership::Shared) {
    for (std::size_t k = lo; k < hi; ++k) *added++ = output.levels[k].new_vertex();
    return;
  }
  // Copies: no write below can change them.
  const double margin = grid_.margins[edge.axis];
  const glm::dvec3 start_mm = edge.start_mm;
  const glm::dvec3 step_mm = grid_.steps_mm[edge.axis];
  const double* crossings = levels_.crossings.data();
  LevelOutput* levels = output.levels.data();
  const auto a = static_cast<double>(edge.a);
  const auto b = static_cast<double>(edge.b);
  for (std::size_t k = lo; k < hi; ++k) {
    const double t = std::clamp(crossing<T>(crossings[k], a, b), margin, 1.0 - margin);
    *added++ = levels[k].new_vertex();
    levels[k].positions.push(glm::vec3(start_mm + step_mm * t), output.arena);
  }
}

template <class T>
void LatticeVertices<T>::add_row(std::size_t y, std::size_t z, LatticeSlice& slice, VertexIds& ids,
                                 SlabOutput& output, Ownership ownership) const {
  const std::size_t nx = grid_.dims[0];
  const std::size_t row = nx * y;
  const std::uint8_t* classes = slice.classes.data() + row;
  const glm::dvec3 row_start_mm = position(0, y, z);
  const auto add = [&](std::size_t x, std::size_t axis, std::size_t next, HandleMap& handles) {
    const std::size_t sample = grid_.sample_index(x, y, z);
    const Edge edge{.class_a = classes[x],
                    .class_b = classes[x + next],
                    .a = samples_[sample],
                    .b = samples_[sample + grid_.strides[axis]],
                    .axis = axis,
                    .start_mm = row_start_mm + grid_.steps_mm[0] * static_cast<double>(x)};
    add_edge(edge, ids, handles[row + x], output, ownership);
  };

  const std::size_t bricks = brick_count(nx);
  const bool has_next_row = y + 1 < grid_.dims[1];
  for (std::size_t b = 0; b < bricks; ++b) {
    const ClassRange& here = slice.bricks[bricks * y + b];
    const std::size_t begin = b * kBrickCells;
    const std::size_t end = std::min(begin + kBrickCells, nx - 1);
    if (here.lo != here.hi) {
      for_each_difference(classes, classes + 1, begin, end,
                          [&](std::size_t x) { add(x, 0, 1, slice.x_edges); });
    }
    if (!has_next_row) continue;
    const ClassRange& beyond = slice.bricks[bricks * (y + 1) + b];
    if (std::min(here.lo, beyond.lo) == std::max(here.hi, beyond.hi)) continue;
    const std::size_t last = b + 1 == bricks ? nx : end;  // the row's last sample has y edges too
    for_each_difference(classes, classes + nx, begin, last,
                        [&](std::size_t x) { add(x, 1, nx, slice.y_edges); });
  }
}

template <class T>
void LatticeVertices<T>::add_corner(std::size_t x, std::size_t y, std::size_t z,
                                    LatticeSlice& slice, VertexIds& ids, SlabOutput& output,
                                    Ownership ownership) const {
  const std::size_t in_slice = x + grid_.dims[0] * y;
  const std::size_t levels = slice.classes[in_slice];
  if (levels == 0) return;
  std::uint32_t* added = ids.add(0, levels, slice.corners[in_slice]);
  for (std::size_t k = 0; k < levels; ++k) *added++ = output.levels[k].new_vertex();
  if (ownership == Ownership::Shared) return;
  const glm::dvec3 position_mm = position(x, y, z);
  for (std::size_t k = 0; k < levels; ++k) output.write_position(k, position_mm);
}

template <class T>
void LatticeVertices<T>::add_border_corners(std::size_t y, std::size_t z, LatticeSlice& slice,
                                            VertexIds& ids, SlabOutput& output,
                                            Ownership ownership) const {
  const auto& [nx, ny, nz] = grid_.dims;
  const auto add = [&](std::size_t x) { add_corner(x, y, z, slice, ids, output, ownership); };
  if (z != 0 && z != nz - 1 && y != 0 && y != ny - 1) {
    add(0);
    add(nx - 1);
    return;
  }
  const std::size_t bricks = brick_count(nx);
  for (std::size_t b = 0; b < bricks; ++b) {
    if (slice.bricks[bricks * y + b].hi == 0) continue;
    const std::size_t end = b + 1 == bricks ? nx : (b + 1) * kBrickCells;
    for (std::size_t x = b * kBrickCells; x < end; ++x) add(x);
  }
}

template <class T>
void LatticeVertices<T>::add_in_slice(std::size_t z, LatticeSlice& slice, VertexIds& ids,
                                      SlabOutput& output, Ownership ownership) const {
  for (std::size_t y = 0; y < grid_.dims[1]; ++y) {
    add_row(y, z, slice, ids, output, ownership);
    add_border_corners(y, z, slice, ids, output, ownership);
  }
}

template <class T>
void LatticeVertices<T>::add_between(std::size_t z, const LatticeSlice& lower,
                                     const LatticeSlice& upper, LatticeGap& gap, VertexIds& ids,
                                     SlabOutput& output) const {
  const std::size_t nx = grid_.dims[0];
  const std::size_t bricks = brick_count(nx);
  for (std::size_t y = 0; y < grid_.dims[1]; ++y) {
    const std::size_t row = nx * y;
    const std::uint8_t* below = lower.classes.data() + row;
    const std::uint8_t* above = upper.classes.data() + row;
    const glm::dvec3 row_start_mm = position(0, y, z);
    const auto add = [&](std::size_t x) {
      const std::size_t sample = grid_.sample_index(x, y, z);
      const Edge edge{.class_a = below[x],
                      .class_b = above[x],
                      .a = samples_[sample],
                      .b = samples_[sample + grid_.strides[2]],
                      .axis = 2,
                      .start_mm = row_start_mm + grid_.steps_mm[0] * static_cast<double>(x)};
      add_edge(edge, ids, gap.z_edges[row + x], output, Ownership::Own);
    };
    for (std::size_t b = 0; b < bricks; ++b) {
      const ClassRange& at_lower = lower.bricks[bricks * y + b];
      const ClassRange& at_upper = upper.bricks[bricks * y + b];
      if (std::min(at_lower.lo, at_upper.lo) == std::max(at_lower.hi, at_upper.hi)) continue;
      const std::size_t end = b + 1 == bricks ? nx : (b + 1) * kBrickCells;
      for_each_difference(below, above, b * kBrickCells, end, add);
    }
  }
}

template class LatticeVertices<std::uint8_t>;
template class LatticeVertices<std::int8_t>;
template class LatticeVertices<std::uint16_t>;
template class LatticeVertices<std::int16_t>;
template class LatticeVertices<std::uint32_t>;
template class LatticeVertices<std::int32_t>;
template class LatticeVertices<float>;
template class LatticeVertices<double>;

}  // namespace nacre
