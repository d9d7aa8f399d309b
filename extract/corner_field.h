#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "extract/cell_topology.h"

namespace nacre {

/// The corner values of a cell relative to a level, positive sign inside: a trilinear field over
/// the unit cube whose zero set is the contour. Any positive scale.
using CornerField = std::array<double, kCellCorners>;

/// The asymptotic decider (Nielson, Hamann 1991, "The Asymptotic Decider: Resolving the Ambiguity
/// in Marching Cubes"): whether the inside corners of an ambiguous face are joined within it.
///
/// With p and q inside and r and s outside, relative to the level, the bilinear field's saddle has
/// the value (p q - r s) / (p + q - r - s). The divisor is positive, so that
///
///     joined  iff  p q >= r s.
///
/// The products are the same from both sides of the face and for any order of its corners, so the
/// cells on both sides agree. A saddle at the level counts as inside, as a sample does.
bool joined_in_face(const CornerField& field, unsigned mask, const CellFace& face);

/// The point of a cell edge where the field vanishes, in the cell's unit cube.
glm::dvec3 edge_point(const CornerField& field, unsigned edge,
                      const std::array<double, 3>& margins);

/// Two loops of a cell that bound one tube instead of two discs.
struct Tunnel {
  std::size_t plus_loop = 0;
  std::size_t minus_loop = 0;
  /// The tube's waist, in the unit cube: a hexagon that runs about the tube as the plus loop does,
  /// and against the minus loop.
  std::array<glm::dvec3, 6> waist;
};

/// The tunnel of a cell, if its field has one.
///
/// Two inside (or outside) parts of a cell's boundary that no face joins are joined within the cell
/// iff a saddle of the field lies within the cell, on their side of the level, that leads to both
/// (the interior ambiguity: Chernyaev 1995, "Marching Cubes 33"). The derivation is in
/// docs/derivations.md, "Tunnels of a trilinear cell".
///
/// @param margin  least distance of the saddle from the cell's faces, as a part of the cell
/// @return        true and the tunnel, or false
bool find_tunnel(const CornerField& field, unsigned mask, const CellCase& cell, double margin,
                 Tunnel& tunnel);

}  // namespace nacre
