#pragma once

#include <span>
#include <vector>

#include "core/emission.h"
#include "reference/cubic.h"

namespace nacre {

/// A linear cue over a cubic's unit interval: beta(s) = at_0 (1-s) + at_1 s, at both ends 0 or
/// more.
struct UnitCue {
  double at_0 = 1.0;
  double at_1 = 1.0;

  double operator()(double s) const noexcept { return at_0 * (1.0 - s) + at_1 * s; }
};

/// A linear piece of an emission map, between two of its knots, continued as a line.
class LinearPiece {
 public:
  /// @param a, b  neighbouring knots
  LinearPiece(const EmissionKnot& a, const EmissionKnot& b) noexcept;

  /// T as a line: not clamped to the piece.
  double operator()(double value) const noexcept {
    return bottom_ + rise_ * ((value * scale_ - start_) / width_);
  }

  double bottom() const noexcept { return bottom_; }
  double top() const noexcept { return bottom_ + rise_; }
  double end() const noexcept { return end_; }  ///< the upper knot's value

 private:
  double bottom_;  ///< emission at the lower knot
  double rise_;    ///< up to the upper one
  double scale_;   ///< 1, or 1/2 where the width would overflow
  double start_;
  double width_;
  double end_;
};

/// The cued emission beta(s) T(f(s)) of a cubic over its unit interval: its maximum and its mean.
///
/// In a linear piece of T the product is a quartic in Bernstein form; [0, 1] is split where f
/// crosses a knot (docs/derivations.md, section 2.5).
class CuedEmission {
 public:
  /// @param map  knots in the unit of f
  explicit CuedEmission(EmissionMap map);

  /// max { floor, beta(s) T(f(s)) }.
  double maximum_above(double floor, const BernsteinCubic& f, const UnitCue& beta) const;

  /// The integral of beta(s) T(f(s)) for s from 0 to 1.
  double mean(const BernsteinCubic& f, const UnitCue& beta) const;

 private:
  double split_maximum_above(double floor, const BernsteinCubic& f, const UnitCue& beta) const;

  EmissionMap map_;
  std::vector<LinearPiece> pieces_;
};

}  // namespace nacre
