#pragma once

namespace nacre {

/// How an emission tolerance is used; it bounds the error everywhere in both.
enum class ToleranceWeight {
  Field,    ///< all of it, wherever a surface is
  Picture,  ///< less of it where the field is shallow, and maxima show more of an error
};

/// "field" or "picture", as in shell files and on the command line.
constexpr const char* name(ToleranceWeight weight) noexcept {
  return weight == ToleranceWeight::Picture ? "picture" : "field";
}

/// Weight of errors where the field is shallowest; 1 where it is steepest.
inline constexpr double kMostWeight = 9.0;
/// At a shell's mean slope.
inline constexpr double kMeanWeight = 3.0;

/// How much larger a tolerance is than what it leaves at a shell's mean slope.
constexpr double weight_at_mean_slope(ToleranceWeight weight) noexcept {
  return weight == ToleranceWeight::Picture ? kMeanWeight : 1.0;
}

}  // namespace nacre
