#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace nacre {

// The contour of one cell, from first principles: no literal case table.
//
// Corner i of a cell lies at (i & 1, i >> 1 & 1, i >> 2 & 1). Edge 4 a + u + 2 v runs along axis a
// at the place u, v along the next two axes in cyclic order. Face 2 a + s lies across axis a, at
// its low (s = 0) or high (s = 1) end. A *mask* has bit i set where corner i is inside.

inline constexpr int kCellCorners = 8;
inline constexpr int kCellEdges = 12;
inline constexpr int kCellFaces = 6;
inline constexpr int kMaxLoops = 4;
inline constexpr int kMaxLoopLength = 12;

/// An edge's two corners, the lower along its axis first.
using CellEdge = std::array<std::uint8_t, 2>;
extern const std::array<CellEdge, kCellEdges> kEdgesOfCell;

/// A face as seen from outside the cell: corners counter-clockwise, and the edge from each corner
/// to the next.
struct CellFace {
  std::array<std::uint8_t, 4> corners;
  std::array<std::uint8_t, 4> edges;
};
extern const std::array<CellFace, kCellFaces> kFacesOfCell;

/// One closed polygon of the contour on the cell's boundary, and its triangulation.
///
/// Vertices are cell edges. The order is counter-clockwise seen from outside the contoured set. No
/// inner edge of the triangulation joins two cell edges of one face: the neighbour across that face
/// might draw the same line, and the line would bound four triangles.
struct CellLoop {
  std::uint8_t length = 0;
  std::uint8_t triangle_count = 0;  ///< length - 2, or 0 where `needs_center`
  bool needs_center = false;        ///< no such triangulation: a fan about an inner vertex
  std::array<std::uint8_t, kMaxLoopLength> edges{};
  std::array<std::array<std::uint8_t, 3>, kMaxLoopLength - 2> triangles{};  ///< of cell edges
};

/// The contour of a cell whose corners and ambiguous faces are decided.
struct CellCase {
  std::uint8_t loop_count = 0;
  std::array<CellLoop, kMaxLoops> loops{};
  /// The connected part of the cell's boundary each corner belongs to, inside or outside, named by
  /// its lowest corner.
  std::array<std::uint8_t, kCellCorners> region{};
};

/// A mask that needs no look at the samples: at most one loop, no ambiguous face. Its triangles, as
/// cell edges, are ready to be copied.
struct SimpleCase {
  static constexpr std::uint8_t kNotSimple = 0xff;
  std::uint8_t triangle_count = 0;       ///< or kNotSimple
  std::array<std::uint8_t, 15> edges{};  ///< past the last triangle: one of its edges
};

/// All cases of all masks, built once.
class CellTopology {
 public:
  static const CellTopology& instance();

  const SimpleCase& simple(unsigned mask) const { return simple_[mask]; }

  /// Faces whose inside corners are two diagonal ones: their contour depends on the samples.
  std::span<const std::uint8_t> ambiguous_faces(unsigned mask) const;

  /// @param joined  bit i: the inside corners of `ambiguous_faces(mask)[i]` are joined in the face
  const CellCase& resolved(unsigned mask, unsigned joined) const {
    return cases_[first_case_[mask] + joined];
  }

 private:
  CellTopology();

  std::array<SimpleCase, 256> simple_;
  std::array<std::array<std::uint8_t, kCellFaces>, 256> ambiguous_{};
  std::array<std::uint8_t, 256> ambiguous_count_{};
  std::array<std::uint32_t, 256> first_case_{};
  std::vector<CellCase> cases_;
};

/// A triangle of a border cap in terms of a face: 0 to 3 its corners, 4 to 7 its edges.
using CapTriangle = std::array<std::uint8_t, 3>;

/// The inside part of a face, cut into triangles counter-clockwise seen from outside the cell.
struct CapCase {
  std::uint8_t triangle_count = 0;
  std::array<CapTriangle, 4> triangles{};
};

/// @param mask    bit i: corner i of the face (in `CellFace` order) is inside
/// @param joined  for the two diagonal masks: the inside corners are joined
const CapCase& cap_case(unsigned mask, bool joined);

}  // namespace nacre
