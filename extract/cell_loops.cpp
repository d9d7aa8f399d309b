#include "extract/cell_loops.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace nacre {
namespace {

constexpr std::uint8_t kNone = 0xff;

/// Where each segment of the contour leads: from cell edge to cell edge.
using Successors = std::array<std::uint8_t, kCellEdges>;

bool inside(unsigned mask, unsigned corner) { return (mask >> corner & 1u) != 0; }

/// Adds the segments of one face. An outline has one or two entries; the exit that belongs to an
/// entry is the next one along the outline where inside corners are kept apart, the previous one
/// where they are joined (the segment then goes round an outside corner).
void add_face_segments(unsigned mask, const CellFace& face, bool joined, Successors& successors) {
  for (unsigned i = 0; i < 4; ++i) {
    const bool enters = !inside(mask, face.corners[i]) && inside(mask, face.corners[(i + 1) % 4]);
    if (!enters) continue;
    for (unsigned step = 1; step < 4; ++step) {
      const unsigned j = (joined ? i + 4 - step : i + step) % 4;
      const bool leaves = inside(mask, face.corners[j]) && !inside(mask, face.corners[(j + 1) % 4]);
      if (!leaves) continue;
      successors[face.edges[i]] = face.edges[j];
      break;
    }
  }
}

/// Names of connected parts, merged one pair at a time.
void merge(std::array<std::uint8_t, kCellCorners>& region, unsigned a, unsigned b) {
  const std::uint8_t kept = std::min(region[a], region[b]);
  const std::uint8_t gone = std::max(region[a], region[b]);
  for (std::uint8_t& name : region) {
    if (name == gone) name = kept;
  }
}

std::array<std::uint8_t, kCellCorners> trace_regions(unsigned mask, unsigned joined_faces) {
  std::array<std::uint8_t, kCellCorners> region{};
  for (unsigned corner = 0; corner < kCellCorners; ++corner) {
    region[corner] = static_cast<std::uint8_t>(corner);
  }
  for (const auto& [a, b] : kEdgesOfCell) {
    if (inside(mask, a) == inside(mask, b)) merge(region, a, b);
  }
  for (unsigned f = 0; f < kCellFaces; ++f) {
    const CellFace& face = kFacesOfCell[f];
    if (!is_ambiguous(mask, face)) continue;
    const bool joined = (joined_faces >> f & 1u) != 0;
    const unsigned first = inside(mask, face.corners[0]) == joined ? 0 : 1;
    merge(region, face.corners[first], face.corners[first + 2]);
  }
  return region;
}

/// The middle of a cell edge, times two.
std::array<int, 3> doubled_middle(unsigned edge) {
  const auto [a, b] = kEdgesOfCell[edge];
  return {(a & 1) + (b & 1), (a >> 1 & 1) + (b >> 1 & 1), (a >> 2 & 1) + (b >> 2 & 1)};
}

/// Squared distance of two edge middles, or infinity where both lie in one face.
double diagonal_cost(unsigned edge_a, unsigned edge_b) {
  const auto a = doubled_middle(edge_a);
  const auto b = doubled_middle(edge_b);
  double sum = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a[axis] == b[axis] && a[axis] != 1) return std::numeric_limits<double>::infinity();
    sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  }
  return sum;
}

/// The cheapest triangulation of every run of a loop's vertices (Klincsek 1980, "Minimal
/// triangulations of polygonal domains").
struct Triangulation {
  std::array<std::array<double, kMaxLoopLength>, kMaxLoopLength> cost{};
  std::array<std::array<std::size_t, kMaxLoopLength>, kMaxLoopLength> apex{};
};

Triangulation cheapest_triangulation(const CellLoop& loop) {
  const std::size_t n = loop.length;
  Triangulation best;
  for (std::size_t length = 2; length < n; ++length) {
    for (std::size_t i = 0; i + length < n; ++i) {
      const std::size_t j = i + length;
      const bool is_side = i == 0 && j == n - 1;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = i + 1; k < j; ++k) {
        const double cost = best.cost[i][k] + best.cost[k][j];
        if (cost >= least) continue;
        least = cost;
        best.apex[i][j] = k;
      }
      best.cost[i][j] = least + (is_side ? 0.0 : diagonal_cost(loop.edges[i], loop.edges[j]));
    }
  }
  return best;
}

void collect_triangles(const Triangulation& best, std::size_t i, std::size_t j, CellLoop& loop) {
  if (j < i + 2) return;
  const std::size_t k = best.apex[i][j];
  loop.triangles[loop.triangle_count++] = {loop.edges[i], loop.edges[k], loop.edges[j]};
  collect_triangles(best, i, k, loop);
  collect_triangles(best, k, j, loop);
}

}  // namespace

bool is_ambiguous(unsigned mask, const CellFace& face) {
  const bool first = inside(mask, face.corners[0]);
  const bool second = inside(mask, face.corners[1]);
  return first != second && first == inside(mask, face.corners[2]) &&
         second == inside(mask, face.corners[3]);
}

void triangulate(CellLoop& loop) {
  const Triangulation best = cheapest_triangulation(loop);
  const std::size_t last = loop.length - std::size_t{1};
  loop.needs_center = !std::isfinite(best.cost[0][last]);
  if (!loop.needs_center) collect_triangles(best, 0, last, loop);
}

CellCase trace_cell(unsigned mask, unsigned joined_faces) {
  Successors successors;
  successors.fill(kNone);
  for (unsigned f = 0; f < kCellFaces; ++f) {
    const CellFace& face = kFacesOfCell[f];
    const bool joined = is_ambiguous(mask, face) && (joined_faces >> f & 1u) != 0;
    add_face_segments(mask, face, joined, successors);
  }
  CellCase traced;
  traced.region = trace_regions(mask, joined_faces);
  for (std::uint8_t first = 0; first < kCellEdges; ++first) {
    if (successors[first] == kNone) continue;
    assert(traced.loop_count < kMaxLoops);
    CellLoop& loop = traced.loops[traced.loop_count++];
    for (std::uint8_t edge = first; successors[edge] != kNone;) {
      loop.edges[loop.length++] = edge;
      const std::uint8_t next = successors[edge];
      successors[edge] = kNone;
      edge = next;
    }
    triangulate(loop);
  }
  return traced;
}

}  // namespace nacre
