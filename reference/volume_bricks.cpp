#include "reference/volume_bricks.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <span>

namespace nacre {
namespace {

template <class T>
struct Range {
  T least = std::numeric_limits<T>::max();
  T greatest = std::numeric_limits<T>::lowest();

  void include(T value) {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
};

/// Widens the range of each brick along a row of samples. Rows are disjoint work; `row` holds one
/// range a brick.
template <class T>
void include_row(std::span<const T> samples, std::vector<Range<T>>& row) {
  const auto size = static_cast<std::int64_t>(samples.size());
  for (std::size_t brick = 0; brick < row.size(); ++brick) {
    const std::int64_t first = static_cast<std::int64_t>(brick) * VolumeBricks::kSide;
    const std::int64_t last = std::min(first + VolumeBricks::kSide, size - 1);
    Range<T> range = row[brick];
    for (std::int64_t x = first; x <= last; ++x)
      range.include(samples[static_cast<std::size_t>(x)]);
    row[brick] = range;
  }
}

/// The bricks of one row along x.
template <class T>
void fill_brick_row(std::span<const T> samples, const glm::i64vec3& dims, int brick_y, int brick_z,
                    VolumeBricks& bricks) {
  std::vector<Range<T>> row(static_cast<std::size_t>(bricks.count.x));
  const std::int64_t y_first = std::int64_t{VolumeBricks::kSide} * brick_y;
  const std::int64_t z_first = std::int64_t{VolumeBricks::kSide} * brick_z;
  const std::int64_t y_last = std::min(y_first + VolumeBricks::kSide, dims.y - 1);
  const std::int64_t z_last = std::min(z_first + VolumeBricks::kSide, dims.z - 1);
  for (std::int64_t z = z_first; z <= z_last; ++z) {
    for (std::int64_t y = y_first; y <= y_last; ++y) {
      const auto begin = static_cast<std::size_t>(dims.x * (y + dims.y * z));
      include_row(samples.subspan(begin, static_cast<std::size_t>(dims.x)), row);
    }
  }
  const std::size_t out = bricks.index({0, brick_y, brick_z});
  for (std::size_t x = 0; x < row.size(); ++x) {
    bricks.least[out + x] = static_cast<double>(row[x].least);
    bricks.greatest[out + x] = static_cast<double>(row[x].greatest);
  }
}

}  // namespace

glm::i64vec3 cell_count(const glm::i64vec3& dims) noexcept {
  return {std::max<std::int64_t>(dims.x - 1, 1), std::max<std::int64_t>(dims.y - 1, 1),
          std::max<std::int64_t>(dims.z - 1, 1)};
}

VolumeBricks make_volume_bricks(const Volume& volume) {
  VolumeBricks bricks;
  constexpr std::int64_t kSide = VolumeBricks::kSide;
  bricks.count = glm::ivec3((cell_count(volume.dims) + (kSide - 1)) / kSide);
  const std::size_t total = bricks.index({0, 0, bricks.count.z});
  bricks.least.resize(total);
  bricks.greatest.resize(total);
  visit_samples(volume, [&]<class T>(std::span<const T> samples) {
    tbb::parallel_for(tbb::blocked_range2d<int>(0, bricks.count.z, 0, bricks.count.y),
                      [&](const tbb::blocked_range2d<int>& rows) {
                        for (int z = rows.rows().begin(); z != rows.rows().end(); ++z) {
                          for (int y = rows.cols().begin(); y != rows.cols().end(); ++y) {
                            fill_brick_row(samples, volume.dims, y, z, bricks);
                          }
                        }
                      });
  });
  return bricks;
}

}  // namespace nacre
