#include "core/emission.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace nacre {
namespace {

/// a + (b - a) * s without overflow for finite a, b; exact at s = 0 and s = 1.
double mix(double a, double b, double s) { return a * (1.0 - s) + b * s; }

/// (x - a) / (b - a) for a < b without overflow of the differences.
double fraction(double x, double a, double b) {
  const double width = b - a;
  if (std::isfinite(width)) return (x - a) / width;
  return (0.5 * x - 0.5 * a) / (0.5 * b - 0.5 * a);
}

}  // namespace

EmissionMap EmissionMap::window(double lo, double hi) {
  if (!std::isfinite(lo) || !std::isfinite(hi) || !(lo < hi)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("window: found {},{}, expected LO < HI, both finite", lo, hi));
  }
  return EmissionMap({{lo, 0.0}, {hi, 1.0}});
}

EmissionMap EmissionMap::piecewise_linear(std::vector<EmissionKnot> knots) {
  if (knots.size() < 2) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("emission map: found {} knots, expected at least 2", knots.size()));
  }
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const auto& [value, emission] = knots[i];
    if (!std::isfinite(value) || !(emission >= 0.0 && emission <= 1.0)) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("emission map: found knot {}:{}, expected a finite value and an "
                              "emission from 0 to 1",
                              value, emission));
    }
    if (i == 0) continue;
    if (!(value > knots[i - 1].value) || emission < knots[i - 1].emission) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("emission map: found {}:{} after {}:{}, expected rising values and "
                              "emissions that do not fall",
                              value, emission, knots[i - 1].value, knots[i - 1].emission));
    }
  }
  if (knots.front().emission == knots.back().emission) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("emission map: found the emission {} everywhere, expected one that "
                            "rises",
                            knots.front().emission));
  }
  return EmissionMap(std::move(knots));
}

double EmissionMap::operator()(double value) const noexcept {
  if (!(value > knots_.front().value)) return knots_.front().emission;
  if (value >= knots_.back().value) return knots_.back().emission;
  const auto above =
      std::upper_bound(knots_.begin(), knots_.end(), value,
                       [](double wanted, const EmissionKnot& knot) { return wanted < knot.value; });
  const EmissionKnot& b = *above;
  const EmissionKnot& a = *(above - 1);
  return std::clamp(mix(a.emission, b.emission, fraction(value, a.value, b.value)), a.emission,
                    b.emission);
}

double EmissionMap::value_at(double t) const {
  if (!(t > 0.0 && t <= knots_.back().emission)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("level: found emission {}, expected above 0 and at most {}", t,
                            knots_.back().emission));
  }
  // With T >= t on the whole line there is no least value: the first knot stands for it.
  if (t <= knots_.front().emission) return knots_.front().value;
  const auto reaching = std::lower_bound(
      knots_.begin(), knots_.end(), t,
      [](const EmissionKnot& knot, double wanted) { return knot.emission < wanted; });
  const EmissionKnot& b = *reaching;
  const EmissionKnot& a = *(reaching - 1);
  return std::clamp(mix(a.value, b.value, (t - a.emission) / (b.emission - a.emission)), a.value,
                    b.value);
}

}  // namespace nacre
