#pragma once

#include <span>
#include <vector>

namespace nacre {

/// A corner of the emission map: at `value` the emission is `emission`.
struct EmissionKnot {
  double value;     ///< in the volume's values (slope and intercept applied); finite
  double emission;  ///< in [0, 1]
};

/// The emission phi = T(value), in [0, 1]: piecewise linear, constant beyond its first and last
/// knot, never decreasing.
///
/// The usual map is a linear window [lo, hi], clamped. Interpolate first, then T: the field between
/// samples is trilinear in the value. (Maps that rise and fall, or fall, are applied to the volume
/// before anything else; see `extract/emission_volume.h`.)
class EmissionMap {
 public:
  /// T(v) = clamp((v - lo) / (hi - lo), 0, 1).
  /// @throws Error  BadArgument unless lo < hi and both are finite
  static EmissionMap window(double lo, double hi);

  /// @param knots  at least two; values strictly increasing and finite, emissions in [0, 1] and
  ///               never decreasing, not all equal
  /// @throws Error BadArgument otherwise
  static EmissionMap piecewise_linear(std::vector<EmissionKnot> knots);

  /// T(value), in [0, 1].
  double operator()(double value) const noexcept;

  /// The contour value of an emission level: v = min { v : T(v) >= t }.
  /// @param t  in (0, T(infinity)]
  /// @throws Error  BadArgument if t is not in that range: no value reaches it
  double value_at(double t) const;

  /// First knot's value: where it starts to rise from its lowest emission (the window's lo).
  double lo() const noexcept { return knots_.front().value; }
  /// Last knot's value: from here on the emission stays at its highest (the window's hi).
  double hi() const noexcept { return knots_.back().value; }

  std::span<const EmissionKnot> knots() const noexcept { return knots_; }

 private:
  explicit EmissionMap(std::vector<EmissionKnot> knots) : knots_(std::move(knots)) {}

  std::vector<EmissionKnot> knots_;
};

}  // namespace nacre
