#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>

#include "reference/exact_walk.h"
#include "reference/layer_ladder.h"

namespace nacre {

/// Where a ray meets a shell.
struct SurfaceHit {
  double t_mm = 0.0;       ///< from the ray's origin
  std::size_t level = 0;   ///< index of the shell's level
  glm::dvec3 normal{0.0};  ///< outward, of unit length; 0 where the field has no gradient
};

/// Ideal shells along rays: the exact boundaries of { value >= v_k } of the trilinear field, with
/// no error of triangles, depth or quantisation. Closed: at the border of the volume they are
/// capped in the border plane.
///
/// A crossing is a root of the cell's cubic; the number of levels reached is carried from cell to
/// cell, so that entries and exits balance (docs/derivations.md, sections 2.6 and 2.7). Where a
/// ray's interval begins or ends inside the volume there is no crossing. The `ExactWalk` must
/// outlive this object. Safe to use from many threads.
class LayerWalk {
 public:
  /// @param levels  the shown ones, values ascending; representatives need not ascend
  /// @throws Error  BadArgument for no levels, or bad ones (see `LayerLadder`)
  LayerWalk(const ExactWalk& walk, std::span<const ShownLevel> levels);

  /// The largest r_k beta over the points inside shells, [H96] eq. 4; 0 where there are none.
  double max_emission(const Ray& ray, const RayInterval& interval = {},
                      const CueField& cue = {}) const;

  /// The integral of beta r_n over distance, n the layer, emission * mm ([H96] eq. 2).
  double emission_integral(const Ray& ray, const RayInterval& interval = {},
                           const CueField& cue = {}) const;

  /// The sum of r_k over all crossings, entering and leaving, [H96] section 2.1.
  double count(const Ray& ray, const RayInterval& interval = {}) const;

  /// The first crossing of any shell, from outside or from inside.
  std::optional<SurfaceHit> first_surface(const Ray& ray, const RayInterval& interval = {}) const;

 private:
  const WalkField& field_;
  LayerLadder ladder_;
};

}  // namespace nacre
