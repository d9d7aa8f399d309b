#include "reference/bright_bricks.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <glm/common.hpp>
#include <tuple>

#include "reference/walk_field.h"

namespace nacre {
namespace {

constexpr int kSide = BrightBricks::kSide;
constexpr int kCoarseSide = VolumeBricks::kSide;
static_assert(kCoarseSide % kSide == 0);

/// The greatest sample of the cells in [first, end), in field units.
template <class T>
double greatest_in(const WalkField& field, std::span<const T> samples, const glm::ivec3& first,
                   const glm::ivec3& end) {
  const glm::i64vec3& dims = field.volume->dims;
  const glm::i64vec3 last = glm::min(glm::i64vec3(end), dims - std::int64_t{1});
  const auto sample = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
    return samples[static_cast<std::size_t>(x + dims.x * (y + dims.y * z))];
  };
  T least = sample(first.x, first.y, first.z);
  T greatest = least;
  for (std::int64_t z = first.z; z <= last.z; ++z) {
    for (std::int64_t y = first.y; y <= last.y; ++y) {
      for (std::int64_t x = first.x; x <= last.x; ++x) {
        least = std::min(least, sample(x, y, z));
        greatest = std::max(greatest, sample(x, y, z));
      }
    }
  }
  return field.factor * static_cast<double>(field.factor > 0.0 ? greatest : least);
}

/// The bright bricks of one layer of coarse bricks, by position.
template <class T>
std::vector<BrightBrick> bright_in_layer(const WalkField& field, std::span<const T> samples,
                                         int coarse_z) {
  std::vector<BrightBrick> bright;
  const double floor = field.emission_of_field.lo();
  const glm::ivec3 cells(field.cells);
  glm::ivec3 coarse(0, 0, coarse_z);
  for (coarse.y = 0; coarse.y < field.bricks.count.y; ++coarse.y) {
    for (coarse.x = 0; coarse.x < field.bricks.count.x; ++coarse.x) {
      if (!(field.bricks.greatest[field.bricks.index(coarse)] > floor)) continue;
      const glm::ivec3 begin = kCoarseSide * coarse;
      const glm::ivec3 end = glm::min(begin + kCoarseSide, cells);
      glm::ivec3 first;
      for (first.z = begin.z; first.z < end.z; first.z += kSide) {
        for (first.y = begin.y; first.y < end.y; first.y += kSide) {
          for (first.x = begin.x; first.x < end.x; first.x += kSide) {
            const double greatest =
                greatest_in(field, samples, first, glm::min(first + kSide, end));
            if (!(greatest > floor)) continue;
            bright.push_back({first, greatest, field.emission_of_field(greatest)});
          }
        }
      }
    }
  }
  return bright;
}

bool brighter(const BrightBrick& a, const BrightBrick& b) {
  const auto key = [](const BrightBrick& brick) {
    return std::tuple(-brick.greatest, brick.first_cell.z, brick.first_cell.y, brick.first_cell.x);
  };
  return key(a) < key(b);
}

}  // namespace

BrightBricks make_bright_bricks(const WalkField& field) {
  std::vector<std::vector<BrightBrick>> layers(static_cast<std::size_t>(field.bricks.count.z));
  visit_samples(*field.volume, [&]<class T>(std::span<const T> samples) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, layers.size(), 1), [&](const auto& range) {
      for (std::size_t z = range.begin(); z != range.end(); ++z) {
        layers[z] = bright_in_layer(field, samples, static_cast<int>(z));
      }
    });
  });
  BrightBricks bright;
  for (const auto& layer : layers) {
    bright.bricks.insert(bright.bricks.end(), layer.begin(), layer.end());
  }
  tbb::parallel_sort(bright.bricks.begin(), bright.bricks.end(), brighter);
  return bright;
}

}  // namespace nacre
