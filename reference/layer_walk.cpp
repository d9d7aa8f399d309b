#include "reference/layer_walk.h"

#include "reference/layer_crossings.h"
#include "reference/layer_emission.h"

namespace nacre {

LayerWalk::LayerWalk(const ExactWalk& walk, std::span<const ShownLevel> levels)
    : field_(walk.field()), ladder_(field_, levels) {}

double LayerWalk::max_emission(const Ray& ray, const RayInterval& interval,
                               const CueField& cue) const {
  const auto entered = field_.enter(ray, interval);
  if (!entered) return 0.0;
  return max_layer_emission(field_, ladder_, entered->line, entered->interval,
                            field_.along(cue, ray, *entered));
}

double LayerWalk::emission_integral(const Ray& ray, const RayInterval& interval,
                                    const CueField& cue) const {
  const auto entered = field_.enter(ray, interval);
  if (!entered) return 0.0;
  return layer_emission_integral(field_, ladder_, entered->line, entered->interval,
                                 field_.along(cue, ray, *entered));
}

double LayerWalk::count(const Ray& ray, const RayInterval& interval) const {
  const auto passage = field_.pass_through(ray, interval);
  if (!passage) return 0.0;
  double sum = 0.0;
  for_each_crossing(field_, ladder_, *passage, [&](const LayerCrossing& crossing) {
    sum += ladder_.shown[crossing.level + 1];
    return true;
  });
  return sum;
}

std::optional<SurfaceHit> LayerWalk::first_surface(const Ray& ray,
                                                   const RayInterval& interval) const {
  const auto passage = field_.pass_through(ray, interval);
  if (!passage) return std::nullopt;
  std::optional<SurfaceHit> hit;
  for_each_crossing(field_, ladder_, *passage, [&](const LayerCrossing& crossing) {
    hit = {passage->t_begin_mm + crossing.t, crossing.level,
           outward_normal(field_, passage->line, crossing)};
    return false;
  });
  return hit;
}

}  // namespace nacre
