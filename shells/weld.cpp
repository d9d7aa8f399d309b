#include "shells/weld.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace nacre {

TriangleMesh weld(const TriangleMesh& mesh) {
  const auto place = [&](std::uint32_t v) {
    const glm::vec3& p = mesh.positions[v];
    return std::tuple(p.x, p.y, p.z);
  };
  std::vector<std::uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
  std::vector<std::uint32_t> first(order.size());  // of the vertices at a vertex's position
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && place(order[i]) == place(order[i - 1]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  TriangleMesh welded;
  std::vector<std::uint32_t> number(order.size());
  for (std::uint32_t v = 0; v < order.size(); ++v) {
    if (first[v] == v) {
      number[v] = static_cast<std::uint32_t>(welded.positions.size());
      welded.positions.push_back(mesh.positions[v]);
    } else {
      number[v] = number[first[v]];
    }
  }
  welded.triangles = mesh.triangles;
  for (glm::uvec3& t : welded.triangles) t = {number[t.x], number[t.y], number[t.z]};
  return welded;
}

}  // namespace nacre
