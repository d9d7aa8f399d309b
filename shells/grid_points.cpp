#include "shells/grid_points.h"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <utility>

namespace nacre {
namespace {

constexpr std::size_t kLeastSlots = 64;
constexpr GridIndex kNeverUsed{-1};
constexpr GridIndex kReleased{-2};

std::size_t hash(const GridIndex& point) noexcept {
  std::uint64_t h =
      (static_cast<std::uint64_t>(point.x) << 32 | static_cast<std::uint32_t>(point.y)) *
      0x9E3779B97F4A7C15ULL;
  h ^= (h >> 32) + static_cast<std::uint64_t>(point.z) * 0xC2B2AE3D27D4EB4FULL;
  return static_cast<std::size_t>(h * 0xFF51AFD7ED558CCDULL >> 7);
}

}  // namespace

glm::i64vec3 twice_area(const GridIndex& a, const GridIndex& b, const GridIndex& c) noexcept {
  const glm::i64vec3 u(b - a);
  const glm::i64vec3 v(c - a);
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

std::int64_t squared_distance(const GridIndex& a, const GridIndex& b) noexcept {
  const glm::i64vec3 d(b - a);
  return d.x * d.x + d.y * d.y + d.z * d.z;
}

bool is_in_grid(const GridIndex& point, int bits) noexcept {
  const std::int32_t side = std::int32_t{1} << bits;
  return std::min({point.x, point.y, point.z}) >= 0 && std::max({point.x, point.y, point.z}) < side;
}

std::vector<GridIndex> OccupiedPoints::around(const GridIndex& point, int reach,
                                              const glm::dvec3& target) const {
  std::vector<GridIndex> points;
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const GridIndex p = point + GridIndex(x, y, z);
        if (is_in_grid(p, bits_)) points.push_back(p);
      }
    }
  }
  const auto distance = [&](const GridIndex& p) {
    const glm::dvec3 d = glm::dvec3(p) - target;
    return glm::dot(d, d);
  };
  std::stable_sort(points.begin(), points.end(), [&](const GridIndex& a, const GridIndex& b) {
    return distance(a) < distance(b);
  });
  return points;
}

void OccupiedPoints::reserve(std::size_t count) {
  // Two thirds full at most: probes stay short.
  const std::size_t wanted = std::bit_ceil(std::max(kLeastSlots, count + count / 2));
  if (wanted <= slots_.size()) return;
  const std::vector<GridIndex> before =
      std::exchange(slots_, std::vector<GridIndex>(wanted, kNeverUsed));
  used_ = 0;
  for (const GridIndex& point : before) {
    if (point.x >= 0) take(point);
  }
}

bool OccupiedPoints::take(const GridIndex& point) {
  if (3 * (used_ + 1) > 2 * slots_.size()) reserve(std::max(kLeastSlots, slots_.size()));
  const std::size_t slot = slot_of(point);
  if (slots_[slot] == point) return false;
  slots_[slot] = point;
  ++used_;
  return true;
}

void OccupiedPoints::release(const GridIndex& point) {
  if (!is_free(point)) slots_[slot_of(point)] = kReleased;
}

bool OccupiedPoints::is_free(const GridIndex& point) const {
  return slots_.empty() || slots_[slot_of(point)] != point;
}

/// Where the point is, or else the first slot that was never used.
std::size_t OccupiedPoints::slot_of(const GridIndex& point) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(point) & mask;
  while (slots_[slot] != point && slots_[slot] != kNeverUsed) slot = (slot + 1) & mask;
  return slot;
}

}  // namespace nacre
