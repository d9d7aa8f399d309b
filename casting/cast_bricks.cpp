#include "casting/cast_bricks.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "reference/brick_samples.h"

namespace nacre {
namespace {

static_assert(CastBrick::kSamples == BrickSamples::kSamples);

void read(const WalkField& field, const CastScale& scale, const glm::ivec3& first_cell,
          BrickValues& values) {
  BrickSamples samples;
  load_samples(field, first_cell, samples);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = scale(samples.sample[i]);
}

}  // namespace

CastBricks::CastBricks(const WalkField& field, const BrightBricks& bright, const CastScale& scale,
                       std::size_t most_bytes)
    : field_(field), bright_(bright), scale_(scale) {
  if (bright.bricks.size() > most_bytes / sizeof(BrickValues)) return;
  kept_.resize(bright.bricks.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, kept_.size()), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      read(field, scale, bright.bricks[i].first_cell, kept_[i]);
    }
  });
}

const float* CastBricks::samples(std::size_t brick, BrickValues& room) const {
  if (!kept_.empty()) return kept_[brick].data();
  read(field_, scale_, bright_.bricks[brick].first_cell, room);
  return room.data();
}

void CastBricks::prefetch(std::size_t brick) const {
  if (kept_.empty()) {
    prefetch_samples(field_, bright_.bricks[brick].first_cell);
    return;
  }
  constexpr std::size_t kLine = 64 / sizeof(float);
  for (std::size_t i = 0; i < BrickValues{}.size(); i += kLine) {
    __builtin_prefetch(kept_[brick].data() + i);
  }
}

}  // namespace nacre
