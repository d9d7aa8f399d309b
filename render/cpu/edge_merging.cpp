#include "render/cpu/edge_merging.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "render/scene_facts.h"

namespace nacre {
namespace {

/// How much the middle counts against the planes: enough to choose a point on a plane or an edge.
constexpr float kMiddleWeight = 1e-2F;

/// Of the reach: how far from the planes around it, in the mean, a vertex may be merged. A flat
/// surface may slide along itself, which shows nowhere; one that leaves its planes shows.
constexpr float kOffPlanes = 0.1F;

/// The surface's extent in the frame of the groups is at least half of 2 to this, and below it.
/// Edges are from a float's step of that, 2 to the -14, to 2 to the 10, so that their sixth powers,
/// as determinants are, keep clear of both ends of a float's range.
constexpr int kFrameExponent = 10;

/// In that frame, a reach that holds nothing back; its square is finite.
constexpr double kFarthestReach = 1 << 20;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Four numbers side by side, in GCC's vector types: any processor has those.
constexpr std::size_t kLanes = 4;
using Floats [[gnu::vector_size(4 * kLanes)]] = float;

template <class Number>
Number least(Number a, Number b) {
  return a < b ? a : b;
}
template <class Number>
Number greatest(Number a, Number b) {
  return a > b ? a : b;
}

/// A point or a direction.
template <class Number>
struct Point {
  Number x{}, y{}, z{};
};

template <class Number>
Number dot(const Point<Number>& u, const Point<Number>& v) {
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

/// A x.
template <class Number>
Point<Number> times_normals(const VertexGroup<Number>& g, const Point<Number>& x) {
  return {g.xx * x.x + g.xy * x.y + g.xz * x.z, g.xy * x.x + g.yy * x.y + g.yz * x.z,
          g.xz * x.x + g.yz * x.y + g.zz * x.z};
}

template <class Number>
Point<Number> twice_middle(const VertexGroup<Number>& g) {
  return {g.lo_x + g.hi_x, g.lo_y + g.hi_y, g.lo_z + g.hi_z};
}

/// x'Ax - 2b'x + c.
template <class Number>
[[gnu::always_inline]] inline Number plane_distance(const VertexGroup<Number>& g,
                                                    const Point<Number>& x) {
  const Point<Number> ax = times_normals(g, x);
  return dot(x, {ax.x - 2.0F * g.b_x, ax.y - 2.0F * g.b_y, ax.z - 2.0F * g.b_z}) + g.c;
}

/// Adds the planes of a part to the group whose box is to hold it.
template <class Number>
void add_planes(VertexGroup<Number>& to, const VertexGroup<Number>& part) {
  const Point<Number> there = twice_middle(to);
  const Point<Number> here = twice_middle(part);
  const Point<Number> away{0.5F * (there.x - here.x), 0.5F * (there.y - here.y),
                           0.5F * (there.z - here.z)};
  const Point<Number> shift = times_normals(part, away);
  to.xx += part.xx;
  to.xy += part.xy;
  to.xz += part.xz;
  to.yy += part.yy;
  to.yz += part.yz;
  to.zz += part.zz;
  to.b_x += part.b_x - shift.x;
  to.b_y += part.b_y - shift.y;
  to.b_z += part.b_z - shift.z;
  to.c += plane_distance(part, away);
}

template <class Number>
VertexGroup<Number> joined(const VertexGroup<Number>& u, const VertexGroup<Number>& v) {
  VertexGroup<Number> group{least(u.lo_x, v.lo_x),    least(u.lo_y, v.lo_y),
                            least(u.lo_z, v.lo_z),    greatest(u.hi_x, v.hi_x),
                            greatest(u.hi_y, v.hi_y), greatest(u.hi_z, v.hi_z)};
  add_planes(group, u);
  add_planes(group, v);
  return group;
}

/// From the middle of the box: the point nearest to the planes, the middle counted as one a little.
template <class Number>
Point<Number> nearest_to_planes(const VertexGroup<Number>& g) {
  const Number weight = kMiddleWeight * (g.xx + g.yy + g.zz);
  const Number xx = g.xx + weight;
  const Number yy = g.yy + weight;
  const Number zz = g.zz + weight;
  // Cramer's rule: the adjugate, then the determinant.
  const Number a_xx = yy * zz - g.yz * g.yz;
  const Number a_xy = g.xz * g.yz - g.xy * zz;
  const Number a_xz = g.xy * g.yz - g.xz * yy;
  const Number a_yy = xx * zz - g.xz * g.xz;
  const Number a_yz = g.xy * g.xz - xx * g.yz;
  const Number a_zz = xx * yy - g.xy * g.xy;
  const Number determinant = xx * a_xx + g.xy * a_xy + g.xz * a_xz;
  const Number inverse = determinant > 0.0F ? 1.0F / determinant : Number{};
  return {inverse * (a_xx * g.b_x + a_xy * g.b_y + a_xz * g.b_z),
          inverse * (a_xy * g.b_x + a_yy * g.b_y + a_yz * g.b_z),
          inverse * (a_xz * g.b_x + a_yz * g.b_y + a_zz * g.b_z)};
}

/// Squared distance to the farthest corner of the box, four times.
template <class Number>
Number farthest_squared(const VertexGroup<Number>& g, const Point<Number>& x) {
  const auto reach = [](Number size, Number from_middle) {
    return size + 2.0F * greatest(from_middle, -from_middle);
  };
  const Point<Number> away{reach(g.hi_x - g.lo_x, x.x), reach(g.hi_y - g.lo_y, x.y),
                           reach(g.hi_z - g.lo_z, x.z)};
  return dot(away, away);
}

/// Where a group goes, from the middle of its box: to the point nearest to the planes, half the way
/// or nowhere, the first from which no vertex is further than the reach.
template <class Number>
Point<Number> merged_point(const VertexGroup<Number>& g, float reach) {
  const Point<Number> best = nearest_to_planes(g);
  const Point<Number> half{0.5F * best.x, 0.5F * best.y, 0.5F * best.z};
  const float most = 4.0F * reach * reach;
  // Chosen, not multiplied by 1, 1/2 or 0: of a point that is not finite nothing may be left.
  const auto whole_way = farthest_squared(g, best) <= most;
  const auto half_way = farthest_squared(g, half) <= most;
  const auto chosen = [&](Number whole, Number halved) {
    return whole_way ? whole : half_way ? halved : Number{};
  };
  return {chosen(best.x, half.x), chosen(best.y, half.y), chosen(best.z, half.z)};
}

/// Whether vertices of both go no further than the reach if they go to the middle of their box.
bool lie_within(const VertexGroup<float>& u, const VertexGroup<float>& v, float reach) {
  const float x = greatest(u.hi_x, v.hi_x) - least(u.lo_x, v.lo_x);
  const float y = greatest(u.hi_y, v.hi_y) - least(u.lo_y, v.lo_y);
  const float z = greatest(u.hi_z, v.hi_z) - least(u.lo_z, v.lo_z);
  return x * x + y * y + z * z <= 4.0F * reach * reach;
}

using GroupNumbers = std::array<std::uint32_t, kLanes>;

/// Groups as rows of four numbers, and their transpose: the same number of four groups a row.
VertexGroup<Floats> side_by_side(const std::vector<VertexGroup<float>>& groups,
                                 const GroupNumbers& numbers) {
  constexpr std::size_t kRows = sizeof(VertexGroup<float>) / sizeof(Floats);
  using Rows = std::array<Floats, kRows>;
  const Rows a = std::bit_cast<Rows>(groups[numbers[0]]);
  const Rows b = std::bit_cast<Rows>(groups[numbers[1]]);
  const Rows c = std::bit_cast<Rows>(groups[numbers[2]]);
  const Rows d = std::bit_cast<Rows>(groups[numbers[3]]);
  std::array<Floats, kLanes * kRows> lanes;
  for (std::size_t row = 0; row < kRows; ++row) {
    const Floats ab_low = __builtin_shufflevector(a[row], b[row], 0, 4, 1, 5);
    const Floats ab_high = __builtin_shufflevector(a[row], b[row], 2, 6, 3, 7);
    const Floats cd_low = __builtin_shufflevector(c[row], d[row], 0, 4, 1, 5);
    const Floats cd_high = __builtin_shufflevector(c[row], d[row], 2, 6, 3, 7);
    lanes[4 * row] = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    lanes[4 * row + 1] = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    lanes[4 * row + 2] = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    lanes[4 * row + 3] = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
  }
  return std::bit_cast<VertexGroup<Floats>>(lanes);
}

/// What merging costs: the squared distance from the planes; negative where it may not be.
Floats merging_costs(const VertexGroup<Floats>& u, const VertexGroup<Floats>& v, float reach) {
  const VertexGroup<Floats> group = joined(u, v);
  const Floats cost = plane_distance(group, merged_point(group, reach));
  const float most = kOffPlanes * reach;
  // Tested as it is, before rounding's less than nothing becomes 0: what is not a number fails.
  return cost <= most * most * (group.xx + group.yy + group.zz) ? greatest(cost, Floats{})
                                                                : Floats{} - 1.0F;
}

/// The power of two that takes a surface to the frame of the groups: lengths keep their digits. It
/// and its inverse are normal numbers.
float frame_scale(const std::vector<glm::vec3>& positions) {
  const Box bounds = bounds_of(positions);
  const glm::dvec3 size = bounds.hi - bounds.lo;
  const double extent = std::max({size.x, size.y, size.z});
  if (!(extent > 0.0)) return 1.0F;
  constexpr int kMost = std::numeric_limits<float>::max_exponent - 2;
  return std::ldexp(1.0F, std::clamp(kFrameExponent - 1 - std::ilogb(extent), -kMost, kMost));
}

}  // namespace

EdgeMerging::EdgeMerging(const TriangleMesh& mesh)
    : positions_(mesh.positions),
      merged_to_(mesh.positions.size()),
      mesh_(mesh),
      frame_from_mm_(frame_scale(mesh.positions)),
      groups_(mesh.positions.size()) {
  std::iota(merged_to_.begin(), merged_to_.end(), 0U);
  const auto in_frame = [&](std::size_t i) { return frame_from_mm_ * positions_[i]; };
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    VertexGroup<float>& group = groups_[i];
    const glm::vec3 position = in_frame(i);
    group.lo_x = group.hi_x = position.x;
    group.lo_y = group.hi_y = position.y;
    group.lo_z = group.hi_z = position.z;
  }
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = in_frame(t.x);
    const glm::vec3 normal = glm::cross(in_frame(t.y) - a, in_frame(t.z) - a);
    const float length = glm::length(normal);
    if (!(length > 0.0F)) continue;
    const glm::vec3 unit = normal / length;
    for (int corner = 0; corner < 3; ++corner) {
      // b and c are 0: the plane goes through the corner.
      VertexGroup<float>& group = groups_[t[corner]];
      group.xx += normal.x * unit.x;
      group.xy += normal.x * unit.y;
      group.xz += normal.x * unit.z;
      group.yy += normal.y * unit.y;
      group.yz += normal.y * unit.z;
      group.zz += normal.z * unit.z;
    }
  }
}

std::vector<EdgeMerging::Pair> EdgeMerging::pairs_within(float reach) const {
  std::vector<Pair> pairs;
  pairs.reserve(mesh_.triangles.size() + mesh_.triangles.size() / 2);
  GroupNumbers first{};
  GroupNumbers second{};
  std::size_t waiting = 0;
  const auto price = [&] {
    if (waiting == 0) return;
    const Floats costs =
        merging_costs(side_by_side(groups_, first), side_by_side(groups_, second), reach);
    for (std::size_t i = 0; i < waiting; ++i) {
      if (costs[i] < 0.0F) continue;
      pairs.push_back({std::bit_cast<std::uint32_t>(+costs[i]), first[i], second[i]});
    }
    waiting = 0;
  };
  for (const glm::uvec3& t : mesh_.triangles) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t u = t[corner];
      const std::uint32_t v = t[corner == 2 ? 0 : corner + 1];
      if (u >= v) continue;  // a triangle beyond the edge has it the other way round
      if (!lie_within(groups_[u], groups_[v], reach)) continue;
      first[waiting] = u;
      second[waiting] = v;
      if (++waiting == kLanes) price();
    }
  }
  price();
  return pairs;
}

/// The upper 22 bits: costs to one part in 8000.
void EdgeMerging::sort_by_key(std::vector<Pair>& pairs) {
  std::vector<Pair> other(pairs.size());
  constexpr unsigned kBits = 11;
  for (unsigned shift = 32 - 2 * kBits; shift < 32; shift += kBits) {
    std::array<std::size_t, 1U << kBits> start{};
    const auto digit = [&](const Pair& pair) { return (pair.key >> shift) & (start.size() - 1); };
    for (const Pair& pair : pairs) ++start[digit(pair)];
    std::exclusive_scan(start.begin(), start.end(), start.begin(), std::size_t{0});
    for (const Pair& pair : pairs) other[start[digit(pair)]++] = pair;
    pairs.swap(other);
  }
}

/// With what each vertex is to be merged: the cheapest pairs first, of those whose ends are free.
std::vector<std::uint32_t> EdgeMerging::partners_within(float reach) const {
  std::vector<Pair> pairs = pairs_within(reach);
  sort_by_key(pairs);
  std::vector<std::uint32_t> partners(groups_.size(), kNone);
  for (const Pair& pair : pairs) {
    if (partners[pair.first] != kNone || partners[pair.second] != kNone) continue;
    partners[pair.first] = pair.second;
    partners[pair.second] = pair.first;
  }
  return partners;
}

/// @return  the new number of each vertex
std::vector<std::uint32_t> EdgeMerging::merge_groups(const std::vector<std::uint32_t>& partners,
                                                     float reach) {
  const float mm_from_frame = 1.0F / frame_from_mm_;
  std::vector<std::uint32_t> numbers(groups_.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < numbers.size(); ++i) {
    const std::uint32_t partner = partners[i];
    if (partner < i) {
      numbers[i] = numbers[partner];
      continue;
    }
    VertexGroup<float> group = groups_[i];
    glm::vec3 position = mesh_.positions[i];
    if (partner != kNone) {
      group = joined(group, groups_[partner]);
      const Point<float> middle = twice_middle(group);
      const Point<float> to = merged_point(group, reach);
      position = 0.5F * glm::vec3(middle.x, middle.y, middle.z) + glm::vec3(to.x, to.y, to.z);
      position *= mm_from_frame;
    }
    groups_[count] = group;
    mesh_.positions[count] = position;
    numbers[i] = count++;
  }
  groups_.resize(count);
  mesh_.positions.resize(count);
  return numbers;
}

/// Drops the triangles that have lost their area.
void EdgeMerging::renumber(const std::vector<std::uint32_t>& numbers) {
  std::size_t kept = 0;
  for (const glm::uvec3& t : mesh_.triangles) {
    const glm::uvec3 merged(numbers[t.x], numbers[t.y], numbers[t.z]);
    if (merged.x != merged.y && merged.y != merged.z && merged.z != merged.x) {
      mesh_.triangles[kept++] = merged;
    }
  }
  mesh_.triangles.resize(kept);
  for (std::uint32_t& vertex : merged_to_) vertex = numbers[vertex];
}

void EdgeMerging::merge_pairs(double reach_mm) {
  const auto reach =
      static_cast<float>(std::min<double>(reach_mm * frame_from_mm_, kFarthestReach));
  renumber(merge_groups(partners_within(reach), reach));
}

double EdgeMerging::farthest_mm() const {
  double squared = 0.0;
  for (std::size_t i = 0; i < merged_to_.size(); ++i) {
    const glm::dvec3 way = glm::dvec3(mesh_.positions[merged_to_[i]]) - glm::dvec3(positions_[i]);
    squared = std::max(squared, glm::dot(way, way));
  }
  return std::sqrt(squared);
}

}  // namespace nacre
