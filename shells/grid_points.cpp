#include "shells/grid_points.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace nacre {

glm::i64vec3 twice_area(const GridIndex& a, const GridIndex& b, const GridIndex& c) noexcept {
  const glm::i64vec3 u(b - a);
  const glm::i64vec3 v(c - a);
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

std::int64_t squared_distance(const GridIndex& a, const GridIndex& b) noexcept {
  const glm::i64vec3 d(b - a);
  return d.x * d.x + d.y * d.y + d.z * d.z;
}

std::vector<GridIndex> OccupiedPoints::around(const GridIndex& point, int reach,
                                              const glm::dvec3& target) const {
  std::vector<GridIndex> points;
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const GridIndex p = point + GridIndex(x, y, z);
        const bool inside = std::min({p.x, p.y, p.z}) >= 0 && std::max({p.x, p.y, p.z}) < side_;
        if (inside) points.push_back(p);
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

std::size_t OccupiedPoints::Hash::operator()(const Key& key) const noexcept {
  std::uint64_t h = static_cast<std::uint64_t>(key.xy) * 0x9E3779B97F4A7C15ULL;
  h ^= (h >> 32) + static_cast<std::uint64_t>(key.z) * 0xC2B2AE3D27D4EB4FULL;
  return static_cast<std::size_t>(h * 0xFF51AFD7ED558CCDULL >> 7);
}

}  // namespace nacre
