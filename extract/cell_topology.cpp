#include "extract/cell_topology.h"

#include "extract/cell_loops.h"

namespace nacre {
namespace {

/// A corner bit of one axis.
constexpr unsigned bit(unsigned axis) { return 1u << (axis % 3); }

constexpr std::array<CellEdge, kCellEdges> edges_of_cell() {
  std::array<CellEdge, kCellEdges> edges{};
  for (unsigned edge = 0; edge < kCellEdges; ++edge) {
    const unsigned axis = edge / 4;
    const unsigned u = (edge & 1u) != 0 ? bit(axis + 1) : 0;
    const unsigned v = (edge & 2u) != 0 ? bit(axis + 2) : 0;
    edges[edge] = {static_cast<std::uint8_t>(u | v), static_cast<std::uint8_t>(u | v | bit(axis))};
  }
  return edges;
}

/// The edge between two corners that differ along one axis.
constexpr std::uint8_t edge_between(unsigned a, unsigned b) {
  std::uint8_t found = 0;
  for (const CellEdge& ends : edges_of_cell()) {
    if ((ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a)) return found;
    ++found;
  }
  return found;
}

constexpr std::array<CellFace, kCellFaces> faces_of_cell() {
  std::array<CellFace, kCellFaces> faces{};
  for (unsigned f = 0; f < kCellFaces; ++f) {
    const unsigned axis = f / 2;
    const bool high = (f & 1u) != 0;
    const unsigned base = high ? bit(axis) : 0;
    // (axis, u, v) is right-handed: u before v is counter-clockwise seen from the high end.
    const unsigned u = bit(high ? axis + 1 : axis + 2);
    const unsigned v = bit(high ? axis + 2 : axis + 1);
    const std::array<unsigned, 4> corners{base, base | u, base | u | v, base | v};
    for (std::size_t i = 0; i < 4; ++i) {
      faces[f].corners[i] = static_cast<std::uint8_t>(corners[i]);
      faces[f].edges[i] = edge_between(corners[i], corners[(i + 1) % 4]);
    }
  }
  return faces;
}

SimpleCase simple_case(const CellCase& traced) {
  SimpleCase simple;
  const CellLoop& loop = traced.loops[0];
  if (traced.loop_count > 1 || loop.needs_center || loop.triangle_count > 5) {
    simple.triangle_count = SimpleCase::kNotSimple;
    return simple;
  }
  simple.triangle_count = loop.triangle_count;
  for (std::size_t i = 0; i < std::size_t{3} * loop.triangle_count; ++i) {
    simple.edges[i] = loop.triangles[i / 3][i % 3];
  }
  for (std::size_t i = std::size_t{3} * loop.triangle_count; i < simple.edges.size(); ++i) {
    simple.edges[i] = loop.edges[0];
  }
  return simple;
}

/// The inside outline of a face with `joined` or separate inside corners, cut into fans.
CapCase trace_cap(unsigned mask, bool joined) {
  const auto inside = [mask](unsigned corner) { return (mask >> (corner % 4) & 1u) != 0; };
  // Walks counter-clockwise from each entry not yet used; at an exit the outline jumps back to the
  // entry of the same run, or on to the next run where the runs are joined.
  CapCase cap;
  const auto add_fan = [&cap](std::span<const std::uint8_t> polygon) {
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      cap.triangles[cap.triangle_count++] = {polygon[0], polygon[i - 1], polygon[i]};
    }
  };
  if (mask == 15) {
    add_fan(std::array<std::uint8_t, 4>{0, 1, 2, 3});
    return cap;
  }
  std::vector<std::uint8_t> polygon;
  for (unsigned i = 0; i < 4; ++i) {
    if (inside(i) || !inside(i + 1)) continue;
    if (!joined) polygon.clear();
    polygon.push_back(static_cast<std::uint8_t>(4 + i));
    unsigned corner = i + 1;
    for (; inside(corner); ++corner) polygon.push_back(static_cast<std::uint8_t>(corner % 4));
    polygon.push_back(static_cast<std::uint8_t>(4 + (corner - 1) % 4));
    if (!joined) add_fan(polygon);
  }
  if (joined) add_fan(polygon);
  return cap;
}

std::array<CapCase, 32> trace_caps() {
  std::array<CapCase, 32> caps;
  for (unsigned mask = 0; mask < 16; ++mask) {
    caps[std::size_t{2} * mask] = trace_cap(mask, false);
    caps[std::size_t{2} * mask + 1] = trace_cap(mask, true);
  }
  return caps;
}

}  // namespace

constexpr std::array<CellEdge, kCellEdges> kEdgesOfCell = edges_of_cell();
constexpr std::array<CellFace, kCellFaces> kFacesOfCell = faces_of_cell();

CellTopology::CellTopology() {
  for (unsigned mask = 0; mask < 256; ++mask) {
    std::uint8_t& count = ambiguous_count_[mask];
    for (unsigned face = 0; face < kCellFaces; ++face) {
      if (is_ambiguous(mask, kFacesOfCell[face])) {
        ambiguous_[mask][count++] = static_cast<std::uint8_t>(face);
      }
    }
    first_case_[mask] = static_cast<std::uint32_t>(cases_.size());
    for (unsigned joined = 0; joined < 1u << count; ++joined) {
      unsigned joined_faces = 0;
      for (unsigned i = 0; i < count; ++i)
        joined_faces |= (joined >> i & 1u) << ambiguous_[mask][i];
      cases_.push_back(trace_cell(mask, joined_faces));
    }
    if (count == 0) {
      simple_[mask] = simple_case(cases_.back());
    } else {
      simple_[mask].triangle_count = SimpleCase::kNotSimple;
    }
  }
}

const CellTopology& CellTopology::instance() {
  static const CellTopology topology;
  return topology;
}

std::span<const std::uint8_t> CellTopology::ambiguous_faces(unsigned mask) const {
  return {ambiguous_[mask].data(), ambiguous_count_[mask]};
}

const CapCase& cap_case(unsigned mask, bool joined) {
  static const std::array<CapCase, 32> caps = trace_caps();
  return caps[2 * mask + (joined ? 1 : 0)];
}

}  // namespace nacre
