#include "extract/cell_contours.h"

#include <algorithm>
#include <array>
#include <optional>

#include "extract/tube_band.h"

namespace nacre {
namespace {

constexpr std::uint64_t kEachByte = 0x0101010101010101;
constexpr std::uint64_t kTopBits = 0x8080808080808080;

/// An inner vertex stays off the cell's faces by this part of it.
constexpr double kInnerMargin = 1.0 / 16;

/// A tunnel's saddle stays off the cell's faces by this many margins of the edges.
constexpr double kTunnelMargins = 16.0;

std::uint8_t byte(std::uint64_t word, std::size_t i) {
  return static_cast<std::uint8_t>(word >> (8 * i));
}

/// Bit i set where byte i is above k: eight comparisons in one addition, where neither the bytes
/// nor k differ from the lowest byte by more than 127. Then no carry leaves a byte.
unsigned mask_above(std::uint64_t classes, std::size_t lo, std::size_t k) {
  const std::uint64_t from_lo = classes - lo * kEachByte;
  const std::uint64_t above = (from_lo + (127 - (k - lo)) * kEachByte) & kTopBits;
  return static_cast<unsigned>((above >> 7) * 0x0102040810204080 >> 56);
}

/// Bytes below k become k; above k + 127 they become that: the mask at k stays.
std::uint64_t clamped_to(std::uint64_t classes, std::size_t k) {
  std::uint64_t clamped = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    clamped |= std::clamp<std::uint64_t>(byte(classes, i), k, k + 127) << (8 * i);
  }
  return clamped;
}

}  // namespace

/// A cell and the level that crosses it.
struct CellContours::Cell {
  const CellRow& row;
  std::size_t x;
  std::size_t k;
  unsigned mask;

  std::uint32_t vertex(std::size_t edge) const { return row.edge_vertex(edge, x, k); }
};

void CellContours::add_layer(CellRow row, SlabOutput& output) const {
  for (std::size_t y = 0; y + 1 < grid_.dims[1]; ++y) {
    add_row(row, output);
    add_caps(row, output);
    row.advance();
  }
}

void CellContours::add_row(const CellRow& row, SlabOutput& output) const {
  const std::size_t cells = grid_.dims[0] - 1;
  const std::size_t bricks = brick_count(grid_.dims[0]);
  std::array<std::uint8_t, kBrickCells> lo{};
  std::array<std::uint8_t, kBrickCells> hi{};
  for (std::size_t b = 0; b < bricks; ++b) {
    const ClassRange range = row.brick_range(b);
    if (range.lo == range.hi) continue;
    row.cell_ranges(b, lo.data(), hi.data());
    const std::size_t begin = b * kBrickCells;
    const std::size_t count = std::min(kBrickCells, cells - begin);
    for_each_difference(lo.data(), hi.data(), 0, count,
                        [&](std::size_t i) { add_cell(row, begin + i, lo[i], hi[i], output); });
  }
}

void CellContours::add_cell(const CellRow& row, std::size_t x, std::size_t lo, std::size_t hi,
                            SlabOutput& output) const {
  const std::uint64_t classes = row.corner_classes(x);
  std::optional<CornerField> halves;
  for (std::size_t k = lo; k < hi; ++k) {
    const unsigned mask =
        hi - lo <= 127 ? mask_above(classes, lo, k) : mask_above(clamped_to(classes, k), k, k);
    const SimpleCase& simple = topology_.simple(mask);
    if (simple.triangle_count == SimpleCase::kNotSimple) {
      if (!halves) halves = half_samples(row, x);
      add_ambiguous({row, x, k, mask}, field(*halves, k), output);
      continue;
    }
    ChunkedStream<glm::uvec3>& triangles = output.levels[k].triangles;
    const auto triangle = [&](std::size_t t) -> glm::uvec3 {
      return {row.edge_vertex(simple.edges[3 * t], x, k),
              row.edge_vertex(simple.edges[3 * t + 1], x, k),
              row.edge_vertex(simple.edges[3 * t + 2], x, k)};
    };
    // Two at once, whether or not there are: a branch on it would be guessed wrong every other
    // time.
    glm::uvec3* room = triangles.room(output.arena);
    room[0] = triangle(0);
    room[1] = triangle(1);
    for (std::size_t t = 2; t < simple.triangle_count; ++t) room[t] = triangle(t);
    triangles.commit(simple.triangle_count);
  }
}

/// Halves: the difference of two finite values may not be finite.
CornerField CellContours::half_samples(const CellRow& row, std::size_t x) const {
  CornerField halves{};
  for (std::size_t i = 0; i < kCellCorners; ++i) {
    halves[i] =
        0.5 *
        samples_[grid_.sample_index(x + (i & 1), row.y() + (i >> 1 & 1), row.z() + (i >> 2 & 1))];
  }
  return halves;
}

CornerField CellContours::field(const CornerField& halves, std::size_t k) const {
  const double level = 0.5 * crossings_[k];
  CornerField field{};
  for (std::size_t i = 0; i < kCellCorners; ++i) {
    field[i] = descending_ ? level - halves[i] : halves[i] - level;
  }
  return field;
}

void CellContours::add_ambiguous(const Cell& cell, const CornerField& values,
                                 SlabOutput& output) const {
  unsigned joined = 0;
  unsigned bit = 1;
  for (const std::uint8_t face : topology_.ambiguous_faces(cell.mask)) {
    if (joined_in_face(values, cell.mask, kFacesOfCell[face])) joined |= bit;
    bit <<= 1;
  }
  const CellCase& resolved = topology_.resolved(cell.mask, joined);
  const double margin = kTunnelMargins * std::ranges::max(grid_.margins);
  Tunnel tunnel;
  const bool has_tunnel =
      resolved.loop_count > 1 && find_tunnel(values, cell.mask, resolved, margin, tunnel);
  for (std::size_t i = 0; i < resolved.loop_count; ++i) {
    if (has_tunnel && (i == tunnel.plus_loop || i == tunnel.minus_loop)) continue;
    add_disc(cell, values, resolved.loops[i], output);
  }
  if (has_tunnel) add_tube(cell, values, resolved, tunnel, output);
}

std::uint32_t CellContours::add_inner_vertex(const Cell& cell, const glm::dvec3& p_cell,
                                             SlabOutput& output) const {
  output.write_position(cell.k,
                        grid_.position_mm(glm::dvec3(cell.x, cell.row.y(), cell.row.z()) + p_cell));
  return output.levels[cell.k].new_vertex();
}

void CellContours::add_disc(const Cell& cell, const CornerField& values, const CellLoop& loop,
                            SlabOutput& output) const {
  for (std::size_t t = 0; t < loop.triangle_count; ++t) {
    const auto& [a, b, c] = loop.triangles[t];
    output.write_triangle(cell.k, {cell.vertex(a), cell.vertex(b), cell.vertex(c)});
  }
  if (!loop.needs_center) return;
  glm::dvec3 center(0.0);
  for (std::size_t i = 0; i < loop.length; ++i) {
    center += edge_point(values, loop.edges[i], grid_.margins) / static_cast<double>(loop.length);
  }
  for (int axis = 0; axis < 3; ++axis) {
    center[axis] = std::clamp(center[axis], kInnerMargin, 1.0 - kInnerMargin);
  }
  const std::uint32_t hub = add_inner_vertex(cell, center, output);
  for (std::size_t i = 0; i < loop.length; ++i) {
    const std::size_t next = (i + 1) % loop.length;
    output.write_triangle(cell.k, {cell.vertex(loop.edges[i]), cell.vertex(loop.edges[next]), hub});
  }
}

void CellContours::add_tube(const Cell& cell, const CornerField& values, const CellCase& resolved,
                            const Tunnel& tunnel, SlabOutput& output) const {
  std::array<std::uint32_t, 6> inner{};
  for (std::size_t i = 0; i < 6; ++i) inner[i] = add_inner_vertex(cell, tunnel.waist[i], output);
  // The second loop sees the waist run backwards.
  std::array<glm::dvec3, 6> waist = tunnel.waist;
  for (const std::size_t which : {tunnel.plus_loop, tunnel.minus_loop}) {
    const CellLoop& loop = resolved.loops[which];
    std::array<glm::dvec3, kMaxLoopLength> points;
    for (std::size_t i = 0; i < loop.length; ++i) {
      points[i] = edge_point(values, loop.edges[i], grid_.margins);
    }
    const auto vertex = [&](std::size_t i) {
      return i < loop.length ? cell.vertex(loop.edges[i]) : inner[i - loop.length];
    };
    for (const auto& [a, b, c] : tube_band(std::span(points).first(loop.length), waist)) {
      output.write_triangle(cell.k, {vertex(a), vertex(b), vertex(c)});
    }
    std::ranges::reverse(waist);
    std::ranges::reverse(inner);
  }
}

void CellContours::add_caps(const CellRow& row, SlabOutput& output) const {
  const auto& [nx, ny, nz] = grid_.dims;
  // The faces the whole row has at the border; its first and last cell have one more.
  std::array<std::size_t, 4> faces{};
  std::size_t face_count = 0;
  if (row.y() == 0) faces[face_count++] = 2;
  if (row.y() + 2 == ny) faces[face_count++] = 3;
  if (row.z() == 0) faces[face_count++] = 4;
  if (row.z() + 2 == nz) faces[face_count++] = 5;
  add_cap(row, 0, 0, output);
  const std::size_t bricks = face_count > 0 ? brick_count(nx) : 0;
  for (std::size_t b = 0; b < bricks; ++b) {
    if (row.brick_range(b).hi == 0) continue;
    const std::size_t end = std::min((b + 1) * kBrickCells, nx - 1);
    for (std::size_t x = b * kBrickCells; x < end; ++x) {
      for (std::size_t i = 0; i < face_count; ++i) add_cap(row, x, faces[i], output);
    }
  }
  add_cap(row, nx - 2, 1, output);
}

void CellContours::add_cap(const CellRow& row, std::size_t x, std::size_t face_index,
                           SlabOutput& output) const {
  const std::uint64_t classes = row.corner_classes(x);
  if (classes == 0) return;
  const CellFace& face = kFacesOfCell[face_index];
  std::size_t levels = 0;
  for (const std::uint8_t corner : face.corners) {
    levels = std::max<std::size_t>(levels, byte(classes, corner));
  }
  for (std::size_t k = 0; k < levels; ++k) {
    unsigned face_mask = 0;
    unsigned cell_mask = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const unsigned inside = byte(classes, face.corners[i]) > k ? 1 : 0;
      face_mask |= inside << i;
      cell_mask |= inside << face.corners[i];
    }
    const bool joined = (face_mask == 5 || face_mask == 10) &&
                        joined_in_face(field(half_samples(row, x), k), cell_mask, face);
    const CapCase& cap = cap_case(face_mask, joined);
    const auto vertex = [&](std::size_t i) {
      return i < 4 ? row.corner_vertex(face.corners[i], x, k)
                   : row.edge_vertex(face.edges[i - 4], x, k);
    };
    for (std::size_t t = 0; t < cap.triangle_count; ++t) {
      const auto& [a, b, c] = cap.triangles[t];
      output.write_triangle(k, {vertex(a), vertex(b), vertex(c)});
    }
  }
}

}  // namespace nacre
