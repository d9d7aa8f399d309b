#include "casting/float_rounding.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "casting/cast_bricks.h"

namespace nacre {
namespace {

constexpr double kMost = 1e30;  // floats hold products of it with what is below 1e8

}  // namespace

double rounding_to_floats(const WalkField& field) {
  constexpr double kStep = 0x1p-24;
  const EmissionMap& map = field.emission_of_field;
  const CastScale scale = cast_scale(map);
  const double width = map.hi() - map.lo();
  const auto size = [&](double sample) { return std::abs((sample - scale.lo) * scale.inverse); };
  const double most = std::max({1.0, size(*std::ranges::min_element(field.bricks.least)),
                                size(*std::ranges::max_element(field.bricks.greatest))});
  const bool held = std::isfinite(width) && std::isfinite(scale.inverse) && most < kMost;
  if (!held) return std::numeric_limits<double>::infinity();
  double steepest = 0.0;
  const auto knots = map.knots();
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double rise = knots[i].emission - knots[i - 1].emission;
    steepest = std::max(steepest, rise / ((knots[i].value - knots[i - 1].value) / width));
  }
  const auto cells = static_cast<double>(std::max({field.cells.x, field.cells.y, field.cells.z}));
  return kStep * (4.0 * cells + 8.0) * most * steepest;
}

bool floats_hold(const WalkField& field, const CellCue& cue) {
  return std::abs(cue.at_origin()) + glm::dot(glm::abs(cue.rise()), glm::dvec3(field.cells)) <
         kMost;
}

}  // namespace nacre
