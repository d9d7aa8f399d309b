#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/progress.h"
#include "core/triangle_mesh.h"
#include "core/volume.h"
#include "extract/swept_surfaces.h"

namespace nacre {

/// The surfaces of all sets { value >= v_k } of a volume, in one sweep over its stored samples.
///
/// Marching cubes (Lorensen, Cline 1987, "Marching Cubes: A High Resolution 3D Surface Construction
/// Algorithm") on the trilinear field of value = slope * stored + intercept. A vertex lies where a
/// level crosses a lattice edge, at t = (v - a) / (b - a). Faces are resolved by the asymptotic
/// decider, cells by the field's saddles, so that the topology follows the trilinear field.
///
/// Each surface
/// - is closed, every edge shared by exactly two triangles that run along it in opposite
///   directions: at the volume's border it is capped in the border plane itself. An axis of one
///   sample spans one spacing, constant;
/// - is counter-clockwise seen from outside the set, also for left-handed matrices and negative
///   slopes;
/// - shares its vertices, and has no triangle without area: vertices stay off the samples by a
///   4096th of an edge (more where float could not tell them apart), also where a sample equals a
///   level (docs/decisions/004-closed-surfaces.md).
///
/// @param volume  all samples finite
/// @param values  contour values, strictly ascending and finite, in the volume's values
/// @param progress  stage "extract"
/// @return        one mesh a value, in LPS mm relative to the centre of the volume's box (see
///                `voxel_box`); empty where no sample reaches the value. The bytes do not depend on
///                the number of threads
/// @throws Error  BadArgument for values out of order or not finite, or a singular matrix;
///                Unsupported where a surface has more than 2^32 - 1 vertices, or float positions
///                cannot resolve the lattice (see `make_sweep_grid`)
///
/// One pass over the samples for up to 255 values, on all threads; bricks of 64 cells that no level
/// crosses cost a few instructions. Beside volume and result it needs about 60 bytes a sample of
/// one slice and what one slab adds to the result, per thread.
std::vector<TriangleMesh> extract_surfaces(const Volume& volume, std::span<const double> values,
                                           const ProgressCallback& progress = {});

/// Surfaces that were extracted and wait to be taken one by one.
class ExtractedSurfaces {
 public:
  /// @param sweeps  each of 255 levels but the last, less those that nothing can reach
  ExtractedSurfaces(std::vector<std::unique_ptr<SweptSurfaces>> sweeps, std::size_t size);

  std::size_t size() const noexcept { return size_; }
  std::size_t triangle_count(std::size_t k) const;

  /// Surface k, as `extract_surfaces` gives it. Once each; safe to call from any thread.
  /// @throws Error  Unsupported for more than 2^32 - 1 vertices, or where the scratch file cannot
  ///                be read back
  TriangleMesh take(std::size_t k);

 private:
  std::vector<std::unique_ptr<SweptSurfaces>> sweeps_;
  std::size_t size_;
};

/// `extract_surfaces` for surfaces too large to stand in memory side by side: the same sweep, the
/// same bytes, but what exceeds the storage's memory waits in a nameless file. The volume is not
/// needed to take them.
ExtractedSurfaces extract_surfaces(const Volume& volume, std::span<const double> values,
                                   const SurfaceStorage& storage,
                                   const ProgressCallback& progress = {});

}  // namespace nacre
