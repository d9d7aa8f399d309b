#pragma once

#include <cstdint>

#include "datasets/vessel_tree.h"

namespace nacre {

/// Radius of the finest vessels, mm: about half a voxel of the default angiogram.
inline constexpr double kTipRadiusMm = 0.32;

/// A model of the arteries of a head, in LPS mm.
///
/// The internal carotids (with their siphons) and the vertebral arteries enter below and feed the
/// circle of Willis; from it the anterior, middle and posterior cerebral and the cerebellar
/// arteries lead to the cortex, where they branch towards evenly spread points of their
/// territories. The superficial temporal arteries run in the scalp. Trunks follow control points,
/// moved at random; a smooth random displacement makes all of it tortuous and its sides unequal.
/// Radii follow Murray's law in each tree; communicating and vertebral arteries are bridges. One
/// bifurcation, of three by chance, carries an aneurysm of 3.5 to 4.8 mm radius.
VesselTree make_cerebral_arteries(std::uint64_t seed);

}  // namespace nacre
