#include "shells/triangle_crossing.h"

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>

namespace nacre {
namespace {

__extension__ using Wide = __int128;  // products of three differences of 23 bits

/// Sign of the volume of a tetrahedron of grid points.
int orientation(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c,
                const glm::ivec3& d) {
  const glm::i64vec3 u(b - a);
  const glm::i64vec3 v(c - a);
  const glm::i64vec3 w(d - a);
  const Wide volume = static_cast<Wide>(u.y * v.z - u.z * v.y) * w.x +
                      static_cast<Wide>(u.z * v.x - u.x * v.z) * w.y +
                      static_cast<Wide>(u.x * v.y - u.y * v.x) * w.z;
  return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

using Sides = std::array<int, 3>;

/// On which sides of triangle `t` the corners of `s` lie.
Sides sides(const GridTriangle& t, const GridTriangle& s) {
  return {orientation(t[0], t[1], t[2], s[0]), orientation(t[0], t[1], t[2], s[1]),
          orientation(t[0], t[1], t[2], s[2])};
}

bool is_on_both_sides(const Sides& sides) {
  return std::max({sides[0], sides[1], sides[2]}) > 0 &&
         std::min({sides[0], sides[1], sides[2]}) < 0;
}

/// Whether the line through p and q meets the closed triangle.
bool line_meets(const glm::ivec3& p, const glm::ivec3& q, const GridTriangle& t) {
  const Sides around{orientation(p, q, t[0], t[1]), orientation(p, q, t[1], t[2]),
                     orientation(p, q, t[2], t[0])};
  return !is_on_both_sides(around);
}

/// Whether a side of `s` meets `t`. @param s_sides  of `t`'s plane
bool side_meets(const GridTriangle& s, const Sides& s_sides, const GridTriangle& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (s_sides[i] * s_sides[j] > 0 || (s_sides[i] == 0 && s_sides[j] == 0)) continue;
    if (line_meets(s[i], s[j], t)) return true;
  }
  return false;
}

}  // namespace

bool cross(const GridTriangle& s, const GridTriangle& t) {
  // The segment in which the planes' common line meets both ends at a side of one of them.
  const Sides of_t = sides(s, t);
  if (!is_on_both_sides(of_t)) return false;
  const Sides of_s = sides(t, s);
  return is_on_both_sides(of_s) && (side_meets(s, of_s, t) || side_meets(t, of_t, s));
}

}  // namespace nacre
