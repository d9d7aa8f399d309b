#include "reference/exact_walk.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include "reference/bright_bricks.h"
#include "reference/cued_emission.h"
#include "reference/walk_field.h"
#include "reference/walk_integral.h"
#include "reference/walk_maximum.h"

namespace nacre {

struct ExactWalk::OnceBright {
  std::once_flag made;
  BrightBricks bricks;
};

ExactWalk::ExactWalk(const Volume& volume, const EmissionMap& emission)
    : field_(std::make_unique<const WalkField>(volume, emission)),
      cued_emission_(std::make_unique<const CuedEmission>(field_->emission_of_field)),
      bright_(std::make_unique<OnceBright>()) {}

ExactWalk::~ExactWalk() = default;
ExactWalk::ExactWalk(ExactWalk&&) noexcept = default;
ExactWalk& ExactWalk::operator=(ExactWalk&&) noexcept = default;

const BrightBricks& ExactWalk::bright_bricks() const {
  std::call_once(bright_->made, [&] { bright_->bricks = make_bright_bricks(*field_); });
  return bright_->bricks;
}

double ExactWalk::max_emission(const Ray& ray, const RayInterval& interval,
                               const CueField& cue) const {
  const auto entered = field_->enter(ray, interval);
  if (!entered) return 0.0;
  if (!is_flat(cue)) {
    return max_cued_emission(*field_, *cued_emission_, entered->line, entered->interval,
                             field_->along(cue, ray, *entered));
  }
  const EmissionMap& emission = field_->emission_of_field;
  return std::max(0.0, cue.at_center) *
         emission(
             max_field(*field_, entered->line, entered->interval, emission.lo(), emission.hi()));
}

double ExactWalk::max_value(const Ray& ray, const RayInterval& interval) const {
  const auto entered = field_->enter(ray, interval);
  if (!entered) return std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return field_->value_of(
      max_field(*field_, entered->line, entered->interval, -kInfinity, kInfinity));
}

double ExactWalk::emission_integral(const Ray& ray, const RayInterval& interval,
                                    const CueField& cue) const {
  const auto entered = field_->enter(ray, interval);
  if (!entered) return 0.0;
  if (!is_flat(cue)) {
    return cued_emission_integral(*field_, *cued_emission_, entered->line, entered->interval,
                                  field_->along(cue, ray, *entered));
  }
  return std::max(0.0, cue.at_center) *
         nacre::emission_integral(*field_, entered->line, entered->interval);
}

}  // namespace nacre
