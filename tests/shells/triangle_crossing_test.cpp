#include "shells/triangle_crossing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <random>
#include <vector>

#include "shells/crossing_candidates.h"

namespace nacre {
namespace {

__extension__ using Wide = __int128;

int volume_sign(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c,
                const glm::ivec3& d) {
  const glm::i64vec3 u(b - a);
  const glm::i64vec3 v(c - a);
  const glm::i64vec3 w(d - a);
  const Wide volume = Wide{u.y * v.z - u.z * v.y} * w.x + Wide{u.z * v.x - u.x * v.z} * w.y +
                      Wide{u.x * v.y - u.y * v.x} * w.z;
  return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

bool lies_on_both_sides(const GridTriangle& s, const GridTriangle& t) {
  int least = 1;
  int greatest = -1;
  for (const glm::ivec3& p : s) {
    const int side = volume_sign(t[0], t[1], t[2], p);
    least = std::min(least, side);
    greatest = std::max(greatest, side);
  }
  return least < 0 && greatest > 0;
}

/// Whether a side of `s` meets `t`, of which it is not in the plane.
bool a_side_meets(const GridTriangle& s, const GridTriangle& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::ivec3& p = s[i];
    const glm::ivec3& q = s[(i + 1) % 3];
    const int from = volume_sign(t[0], t[1], t[2], p);
    const int to = volume_sign(t[0], t[1], t[2], q);
    if (from * to > 0 || (from == 0 && to == 0)) continue;
    const int ab = volume_sign(p, q, t[0], t[1]);
    const int bc = volume_sign(p, q, t[1], t[2]);
    const int ca = volume_sign(p, q, t[2], t[0]);
    if (std::min({ab, bc, ca}) >= 0 || std::max({ab, bc, ca}) <= 0) return true;
  }
  return false;
}

/// By definition: where they meet, a side of one meets the other.
bool cross_by_sides(const GridTriangle& s, const GridTriangle& t) {
  return lies_on_both_sides(s, t) && lies_on_both_sides(t, s) &&
         (a_side_meets(s, t) || a_side_meets(t, s));
}

/// Triangles in a cube of the grid, four of ten slivers, without area, in one plane or near it.
class TriangleSource {
 public:
  explicit TriangleSource(int side) : side_(side) {}

  GridTriangle draw() {
    GridTriangle t{point(), point(), point()};
    switch (number(10)) {
      case 0: t[1] = t[0] + (t[1] - t[0]) / std::max(side_ / 3, 1); break;
      case 1: t[2] = (t[0] + t[1]) / 2; break;
      case 2: t[0].z = t[1].z = t[2].z = side_ / 2; break;
      case 3:  // within a step of that plane: floats cannot tell on which side corners are
        for (glm::ivec3& p : t) p.z = std::clamp(side_ / 2 + number(3) - 1, 0, side_ - 1);
        break;
      default: break;
    }
    return t;
  }

  /// With a corner or a side of another one, as often as not.
  GridTriangle draw_beside(const GridTriangle& other) {
    GridTriangle t = draw();
    const auto shared = static_cast<std::size_t>(number(5));
    for (std::size_t i = 0; i < std::min<std::size_t>(shared, 3) && shared < 3; ++i) {
      t[i] = other[(i + 1) % 3];
    }
    return t;
  }

 private:
  int number(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  glm::ivec3 point() { return {number(side_), number(side_), number(side_)}; }

  int side_;
  std::mt19937 random_{5};
};

class TriangleCrossing : public ::testing::TestWithParam<int> {};

TEST_P(TriangleCrossing, IsWhatSidesThatMeetSay) {
  TriangleSource source(GetParam());
  int crossing = 0;
  for (int i = 0; i < 20000; ++i) {
    const GridTriangle s = source.draw();
    const GridTriangle t = source.draw_beside(s);
    const bool expected = cross_by_sides(s, t);
    ASSERT_EQ(cross(s, t), expected);
    ASSERT_EQ(cross(t, s), expected);
    crossing += expected ? 1 : 0;
  }
  EXPECT_GT(crossing, 500);
}

// All that cross are found, in the one brick that counts them, and few that do not.
TEST_P(TriangleCrossing, OfCandidatesAreAll) {
  const int bits = std::bit_width(static_cast<unsigned>(GetParam() - 1)) - 1;
  const int half = 1 << bits;
  TriangleSource source(GetParam());
  std::size_t crossing = 0;
  std::size_t asked = 0;
  std::size_t pairs = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<GridTriangle> outer;
    std::vector<GridTriangle> inner;
    for (int i = 0; i < 12; ++i) outer.push_back(source.draw());
    for (int i = 0; i < 70 + round; ++i) {
      inner.push_back(source.draw_beside(outer[static_cast<std::size_t>(i) % outer.size()]));
    }
    std::vector<std::uint8_t> times(outer.size() * inner.size());
    CrossingCandidates candidates;
    std::vector<std::uint32_t> found;
    for (int brick = 0; brick < 8; ++brick) {
      const glm::ivec3 lowest((brick & 1) * half, (brick >> 1 & 1) * half, (brick >> 2) * half);
      // A brick's triangles are those whose boxes reach it.
      const auto ends_before = [&](const GridTriangle& t) {
        const glm::ivec3 hi = glm::max(glm::max(t[0], t[1]), t[2]);
        return glm::any(glm::lessThan(hi, lowest));
      };
      const auto begins_beyond = [&](const GridTriangle& t) {
        const glm::ivec3 lo = glm::min(glm::min(t[0], t[1]), t[2]);
        return glm::any(glm::greaterThanEqual(lo, lowest + half));
      };
      std::vector<GridTriangle> here;
      std::vector<std::size_t> numbers;
      for (std::size_t i = 0; i < inner.size(); ++i) {
        if (ends_before(inner[i]) || begins_beyond(inner[i])) continue;
        here.push_back(inner[i]);
        numbers.push_back(i);
      }
      candidates.assign(here, lowest, glm::ivec3(bits));
      for (std::size_t o = 0; o < outer.size(); ++o) {
        if (ends_before(outer[o]) || begins_beyond(outer[o])) continue;
        candidates.find(outer[o], found);
        ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
        for (const std::uint32_t i : found) ++times[o * inner.size() + numbers[i]];
      }
    }
    for (std::size_t o = 0; o < outer.size(); ++o) {
      for (std::size_t i = 0; i < inner.size(); ++i) {
        const int count = times[o * inner.size() + i];
        ASSERT_LE(count, 1);
        if (cross_by_sides(outer[o], inner[i])) {
          ASSERT_EQ(count, 1);
          ++crossing;
        }
        asked += static_cast<std::size_t>(count);
        ++pairs;
      }
    }
  }
  EXPECT_GT(crossing, 500u);
  EXPECT_LT(2 * asked, pairs);
}

// From grids where nothing is rounded to the finest.
INSTANTIATE_TEST_SUITE_P(Grids, TriangleCrossing,
                         ::testing::Values(4, 40, 300, 1 << 12, 1 << 16, 1 << 20, (1 << 20) + 9,
                                           1 << 23));

}  // namespace
}  // namespace nacre
