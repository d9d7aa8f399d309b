#pragma once

#include <memory>

#include "core/camera.h"
#include "core/emission.h"
#include "core/picture.h"
#include "core/volume.h"
#include "reference/cue_field.h"

namespace nacre {

struct WalkField;
struct BrightBricks;
class CuedEmission;

/// Exact maximum and integral of a volume's emission along rays, with and without a depth cue.
///
/// Between samples the value is trilinear, so along a ray it is a cubic polynomial in each cell:
/// its maximum lies at the cell's ends or at the roots of a quadratic, its integral is a closed
/// form, split where it crosses a knot of the emission map. A cue is linear along a ray, so that
/// the cued emission is a quartic (docs/derivations.md, section 2). All in double; what is left is
/// rounding (about 1e-15 of the volume's range, times the slope of the map).
///
/// Setting up costs one pass over the volume (ranges of 8^3 bricks, which the walk uses to skip
/// what cannot matter). The volume must outlive this object. Safe to use from many threads.
class ExactWalk {
 public:
  ExactWalk(const Volume& volume, const EmissionMap& emission);
  ~ExactWalk();
  ExactWalk(ExactWalk&&) noexcept;
  ExactWalk& operator=(ExactWalk&&) noexcept;

  /// max { beta(p) T(value) } over the ray's points p inside the volume's box and the interval; 0
  /// where there are none. In [0, 1] without a cue. Where beta is negative it counts as 0.
  double max_emission(const Ray& ray, const RayInterval& interval = {},
                      const CueField& cue = {}) const;

  /// The largest value itself, in the volume's values; NaN where the ray misses the box.
  double max_value(const Ray& ray, const RayInterval& interval = {}) const;

  /// Integral of beta(p) T(value) over distance, emission * mm; 0 where the ray misses the box.
  double emission_integral(const Ray& ray, const RayInterval& interval = {},
                           const CueField& cue = {}) const;

  /// The prepared volume, for other walks of it (`LayerWalk`).
  const WalkField& field() const { return *field_; }

  /// The emission's map prepared for cues, in field units.
  const CuedEmission& cued_emission() const { return *cued_emission_; }

  /// Where the volume is bright. Made when first asked for, in one pass; safe from many threads.
  const BrightBricks& bright_bricks() const;

 private:
  struct OnceBright;

  std::unique_ptr<const WalkField> field_;
  std::unique_ptr<const CuedEmission> cued_emission_;
  std::unique_ptr<OnceBright> bright_;
};

}  // namespace nacre
