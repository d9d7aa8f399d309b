#include "reference/triangle_rays.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>
#include <utility>

namespace nacre {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
constexpr std::size_t kBins = 16;
/// Below it ranges are halved by number: what is deeper is so crowded that splits by place do not
/// get anywhere. 32 halvings more and 2^32 triangles are in leaves.
constexpr int kDeepest = 56;
constexpr std::size_t kStack = kDeepest + 33;

}  // namespace

/// Builds the subtrees, each by itself in its part of the arrays: whatever runs first, the result
/// is the same.
class TriangleRays::Builder {
 public:
  explicit Builder(TriangleRays& rays) : rays_(rays), boxes_(rays.triangles_.size()) {
    tbb::parallel_for(std::size_t{0}, boxes_.size(), [&](std::size_t i) {
      for (const glm::dvec3& corner : rays_.corners(static_cast<std::uint32_t>(i))) {
        include(boxes_[i], corner);
      }
    });
  }

  /// Builds the tree over order_[begin, end) at `node`; it takes fewer than 2 (end - begin) nodes.
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end, int depth) {
    Box box;
    Box centers;
    for (std::uint32_t i = begin; i < end; ++i) {
      const Box& triangle = boxes_[rays_.order_[i]];
      include(box, triangle);
      include(centers, center(triangle));
    }
    rays_.nodes_[node] = {box, begin, end - begin};
    if (end - begin <= kLeafTriangles) return;

    const std::uint32_t middle = split(begin, end, centers, depth);
    const std::uint32_t left = node + 1;
    const std::uint32_t right = node + 2 * (middle - begin);
    rays_.nodes_[node].first = right;
    rays_.nodes_[node].count = 0;
    constexpr std::uint32_t kWorthATask = 4096;
    const auto build_left = [&] { build(left, begin, middle, depth + 1); };
    const auto build_right = [&] { build(right, middle, end, depth + 1); };
    if (end - begin < kWorthATask) {
      build_left();
      build_right();
    } else {
      tbb::parallel_invoke(build_left, build_right);
    }
  }

 private:
  struct Bin {
    Box box;
    std::uint32_t count = 0;
  };

  static void include(Box& box, const glm::dvec3& p) {
    box.lo = glm::min(box.lo, p);
    box.hi = glm::max(box.hi, p);
  }

  static void include(Box& box, const Box& other) {
    box.lo = glm::min(box.lo, other.lo);
    box.hi = glm::max(box.hi, other.hi);
  }

  static glm::dvec3 center(const Box& box) { return 0.5 * box.lo + 0.5 * box.hi; }

  /// Half of its surface.
  static double area(const Box& box) {
    const glm::dvec3 size = box.hi - box.lo;
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }

  /// Sorts order_[begin, end) into two parts; returns where the second begins.
  std::uint32_t split(std::uint32_t begin, std::uint32_t end, const Box& centers, int depth) {
    const glm::dvec3 size = centers.hi - centers.lo;
    int axis = size.x >= size.y ? 0 : 1;
    if (size.z > size[axis]) axis = 2;
    const std::uint32_t half = begin + (end - begin) / 2;
    if (!(size[axis] > 0.0) || depth >= kDeepest) return half;

    const double scale = static_cast<double>(kBins) / size[axis];
    const auto bin_of = [&](std::uint32_t triangle) {
      const double place = (center(boxes_[triangle])[axis] - centers.lo[axis]) * scale;
      return std::min(static_cast<std::size_t>(place), kBins - 1);
    };
    std::array<Bin, kBins> bins;
    for (std::uint32_t i = begin; i < end; ++i) {
      Bin& bin = bins[bin_of(rays_.order_[i])];
      include(bin.box, boxes_[rays_.order_[i]]);
      ++bin.count;
    }
    const std::size_t first_right = cheapest_split(bins);
    const auto order = rays_.order_.begin();
    const auto middle = std::partition(order + begin, order + end, [&](std::uint32_t triangle) {
      return bin_of(triangle) < first_right;
    });
    const auto found = static_cast<std::uint32_t>(middle - order);
    return found == begin || found == end ? half : found;
  }

  /// The bin from which on triangles go to the right: least area times triangles, summed.
  static std::size_t cheapest_split(const std::array<Bin, kBins>& bins) {
    std::array<double, kBins> right_cost{};
    Bin right;
    for (std::size_t i = kBins; i-- > 1;) {
      include(right.box, bins[i].box);
      right.count += bins[i].count;
      right_cost[i] = right.count > 0 ? right.count * area(right.box) : 0.0;
    }
    Bin left;
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = kBins / 2;
    for (std::size_t i = 1; i < kBins; ++i) {
      include(left.box, bins[i - 1].box);
      left.count += bins[i - 1].count;
      if (left.count == 0) continue;
      const double cost = left.count * area(left.box) + right_cost[i];
      if (cost < least) {
        least = cost;
        best = i;
      }
    }
    return best;
  }

  TriangleRays& rays_;
  std::vector<Box> boxes_;
};

/// Whether a line may cross what is in a box.
class TriangleRays::LineBoxTest {
 public:
  /// Rounding moves a point of the ray's frame by less than 1e-15 of the distances involved.
  LineBoxTest(const Ray& ray, double reach_mm) : origin_(ray.origin_mm) {
    double farthest = reach_mm;
    for (const int axis : {0, 1, 2}) farthest = std::max(farthest, std::abs(origin_[axis]));
    hair_mm_ = 1e-14 * farthest;
    for (const int axis : {0, 1, 2}) {
      constexpr double kStill = 1e-200;  // moves by nothing, and its inverse might overflow
      is_still_[axis] = std::abs(ray.direction[axis]) < kStill;
      inverse_[axis] = is_still_[axis] ? 0.0 : 1.0 / ray.direction[axis];
    }
  }

  bool may_cross(const Box& box) const {
    double enter = -std::numeric_limits<double>::infinity();
    double exit = std::numeric_limits<double>::infinity();
    for (const int axis : {0, 1, 2}) {
      const double lo = box.lo[axis] - hair_mm_ - origin_[axis];
      const double hi = box.hi[axis] + hair_mm_ - origin_[axis];
      if (is_still_[axis]) {
        if (lo > 0.0 || hi < 0.0) return false;
        continue;
      }
      const double t0 = lo * inverse_[axis];
      const double t1 = hi * inverse_[axis];
      enter = std::max(enter, std::min(t0, t1));
      exit = std::min(exit, std::max(t0, t1));
    }
    return enter <= exit;
  }

 private:
  glm::dvec3 origin_;
  glm::dvec3 inverse_{0.0};
  glm::bvec3 is_still_{false};
  double hair_mm_ = 0.0;
};

TriangleRays::TriangleRays(std::vector<glm::dvec3> positions_mm,
                           std::span<const glm::uvec3> triangles)
    : positions_mm_(std::move(positions_mm)),
      triangles_(triangles.begin(), triangles.end()),
      order_(triangles.size()) {
  if (triangles_.empty()) return;
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.resize(2 * triangles_.size());
  Builder(*this).build(0, 0, static_cast<std::uint32_t>(triangles_.size()), 0);
  const Box& all = nodes_.front().box;
  for (const int axis : {0, 1, 2}) {
    reach_mm_ = std::max({reach_mm_, std::abs(all.lo[axis]), std::abs(all.hi[axis])});
  }
}

std::array<glm::dvec3, 3> TriangleRays::corners(std::uint32_t triangle) const {
  const glm::uvec3& t = triangles_[triangle];
  return {positions_mm_[t.x], positions_mm_[t.y], positions_mm_[t.z]};
}

template <class Visit>
void TriangleRays::traverse(const Ray& ray, RayInterval& interval, Visit&& visit) const {
  if (nodes_.empty()) return;
  const RayCoordinates frame(ray);
  const LineBoxTest line(ray, reach_mm_);
  // A crossing's t lies between its corners', and those between the planes of the box that hold
  // them: culling by these planes alone can lose nothing to rounding.
  const auto span = [&](const Box& box) {
    return std::minmax({frame.t_of_plane(box.lo[frame.steepest_axis()]),
                        frame.t_of_plane(box.hi[frame.steepest_axis()])});
  };
  const auto holds = [&](const Node& node) {
    const std::pair<double, double> t = span(node.box);
    return t.first <= interval.t_end_mm && t.second >= interval.t_begin_mm &&
           line.may_cross(node.box);
  };
  std::array<std::uint32_t, kStack> stack{};
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const std::uint32_t index = stack[--waiting];
    const Node& node = nodes_[index];
    if (!holds(node)) continue;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto [a, b, c] = corners(order_[i]);
      const auto met = crossing(frame(a), frame(b), frame(c));
      if (!met || met->t_mm < interval.t_begin_mm || met->t_mm > interval.t_end_mm) continue;
      visit(TriangleHit{*met, order_[i]});
    }
    if (node.count > 0) continue;
    // The nearer child on top.
    const std::pair<double, double> left = span(nodes_[index + 1].box);
    const std::pair<double, double> right = span(nodes_[node.first].box);
    const bool left_first = left.first <= right.first;
    stack[waiting++] = left_first ? node.first : index + 1;
    stack[waiting++] = left_first ? index + 1 : node.first;
  }
}

std::optional<TriangleHit> TriangleRays::nearest(const Ray& ray,
                                                 const RayInterval& interval) const {
  std::optional<TriangleHit> best;
  RayInterval rest = interval;
  traverse(ray, rest, [&](const TriangleHit& hit) {
    if (best && hit.t_mm == best->t_mm && hit.triangle > best->triangle) return;
    best = hit;
    rest.t_end_mm = hit.t_mm;
  });
  return best;
}

std::vector<TriangleHit> TriangleRays::all(const Ray& ray, const RayInterval& interval) const {
  std::vector<TriangleHit> hits;
  RayInterval whole = interval;
  traverse(ray, whole, [&](const TriangleHit& hit) { hits.push_back(hit); });
  std::ranges::sort(hits, [](const TriangleHit& a, const TriangleHit& b) {
    return a.t_mm != b.t_mm ? a.t_mm < b.t_mm : a.triangle < b.triangle;
  });
  return hits;
}

}  // namespace nacre
