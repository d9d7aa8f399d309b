#include "shells/triangle_crossing.h"

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>

namespace nacre {
namespace {

__extension__ using Wide = __int128;  // products of three differences of 23 bits

/// Up to so many bits six such products stay below 2^63.
constexpr int kNarrowBits = 20;

/// Sign of the volume of a tetrahedron of grid points.
template <class Product>
int orientation(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c,
                const glm::ivec3& d) {
  const glm::i64vec3 u(b - a);
  const glm::i64vec3 v(c - a);
  const glm::i64vec3 w(d - a);
  const Product volume = static_cast<Product>(u.y * v.z - u.z * v.y) * w.x +
                         static_cast<Product>(u.z * v.x - u.x * v.z) * w.y +
                         static_cast<Product>(u.x * v.y - u.y * v.x) * w.z;
  return (volume > 0 ? 1 : 0) - (volume < 0 ? 1 : 0);
}

using Sides = std::array<int, 3>;

/// On which sides of triangle `t` the corners of `s` lie.
template <class Product>
Sides sides(const GridTriangle& t, const GridTriangle& s) {
  return {orientation<Product>(t[0], t[1], t[2], s[0]),
          orientation<Product>(t[0], t[1], t[2], s[1]),
          orientation<Product>(t[0], t[1], t[2], s[2])};
}

bool is_on_both_sides(const Sides& sides) {
  return std::max({sides[0], sides[1], sides[2]}) > 0 &&
         std::min({sides[0], sides[1], sides[2]}) < 0;
}

/// The corner that is alone on its side of those that are on both.
std::size_t lone_corner(const Sides& sides) {
  const int positive = (sides[0] > 0) + (sides[1] > 0) + (sides[2] > 0);
  const int lone = positive == 1 ? 1 : -1;
  return sides[0] == lone ? 0 : sides[1] == lone ? 1 : 2;
}

/// The other two, in their order or against it.
std::pair<std::size_t, std::size_t> other_corners(std::size_t corner, bool is_forward) {
  constexpr std::array<std::size_t, 5> kCorners{0, 1, 2, 0, 1};
  const std::size_t next = kCorners[corner + 1];
  const std::size_t last = kCorners[corner + 2];
  return is_forward ? std::pair(next, last) : std::pair(last, next);
}

/// Guigue, Devillers 2003, "Fast and Robust Triangle-Triangle Overlap Test Using Orientation
/// Predicates": each triangle meets the planes' common line in a segment, between the two sides
/// from its lone corner. Faced alike, two orientations tell whether the segments are apart.
template <class Product>
bool do_cross(const GridTriangle& s, const GridTriangle& t) {
  const Sides s_sides = sides<Product>(t, s);
  if (!is_on_both_sides(s_sides)) return false;
  const Sides t_sides = sides<Product>(s, t);
  if (!is_on_both_sides(t_sides)) return false;
  const std::size_t s0 = lone_corner(s_sides);
  const std::size_t t0 = lone_corner(t_sides);
  const auto [s1, s2] = other_corners(s0, t_sides[t0] > 0);
  const auto [t1, t2] = other_corners(t0, s_sides[s0] > 0);
  return orientation<Product>(s[s0], s[s1], t[t0], t[t1]) <= 0 &&
         orientation<Product>(s[s0], s[s2], t[t2], t[t0]) <= 0;
}

}  // namespace

bool cross(const GridTriangle& s, const GridTriangle& t) {
  int bits = 0;
  for (const GridTriangle& triangle : {s, t}) {
    for (const glm::ivec3& p : triangle) bits |= p.x | p.y | p.z;
  }
  const bool is_narrow = (bits >> kNarrowBits) == 0;
  return is_narrow ? do_cross<std::int64_t>(s, t) : do_cross<Wide>(s, t);
}

}  // namespace nacre
