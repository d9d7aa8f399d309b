// The kernel of `cluster_kernel.h` for vectors of NACRE_VECTOR_BYTES bytes, in the namespace
// NACRE_KERNEL. Included once by each instruction set's source, after all other headers, so that
// nothing but this is compiled for that set. Uses no library function for the same reason: not
// even std::array, whose operators are some.

// In this order: each uses those before.
// clang-format off
#include "render/cpu/kernel_vectors.h"
#include "render/cpu/kernel_projection.h"
#include "render/cpu/kernel_triangles.h"
#include "render/cpu/kernel_coverage.h"
// clang-format on

namespace nacre::NACRE_KERNEL {
namespace {

/// Depths, and how far corners are rounded aside, pixels.
struct PlaneCorner {
  Floats x, y, depth;

  /// Rounded less exact.
  Floats off(const Floats& pixel) const {
    const Floats sub_pixels = pixel * static_cast<float>(kSubpixels);
    return ((sub_pixels + kRound) - kRound - sub_pixels) / static_cast<float>(kSubpixels);
  }
  /// The depth of a plane of that slope where the corner was rounded to. What is thinner than
  /// rounding has no slope that means anything, so depth moves by `most` at most.
  Floats rounded_depth(const Floats& slope_x, const Floats& slope_y, const Floats& most) const {
    return depth + least(greatest(slope_x * off(x) + slope_y * off(y), -most), most);
  }
};

inline Corners<Floats> depths_at(const PixelVertices& vertices, const CornerArrays& corners,
                                 int t) {
  return look_up<Floats>(vertices.depth, vertices.count, corners, t);
}

inline Corners<PlaneCorner> plane_corners(const PixelVertices& vertices,
                                          const CornerArrays& corners, int t) {
  const auto x = look_up<Floats>(vertices.x, vertices.count, corners, t);
  const auto y = look_up<Floats>(vertices.y, vertices.count, corners, t);
  const auto depth = depths_at(vertices, corners, t);
  return {{x.a, y.a, depth.a}, {x.b, y.b, depth.b}, {x.c, y.c, depth.c}};
}

/// Moves the depths of corners to where these were rounded, along the plane of the triangle: a
/// crossing then lies where the ray meets the triangle as it was, not up to the slope times 1/512
/// of a pixel aside. Triangles without area have no slope.
inline void stay_on_plane(PlaneCorner& a, PlaneCorner& b, PlaneCorner& c, bool perspective) {
  const PlaneCorner u{b.x - a.x, b.y - a.y, b.depth - a.depth};
  const PlaneCorner v{c.x - a.x, c.y - a.y, c.depth - a.depth};
  const Floats area = u.x * v.y - u.y * v.x;
  const Floats inverse = area == 0.0F ? Floats{} : 1.0F / area;
  const Floats slope_x = (u.depth * v.y - v.depth * u.y) * inverse;
  const Floats slope_y = (v.depth * u.x - u.depth * v.x) * inverse;
  const Floats lowest = least(least(a.depth, b.depth), c.depth);
  Floats most = 0.25F * (greatest(greatest(a.depth, b.depth), c.depth) - lowest);
  if (perspective) most = least(most, 0.2F * lowest);  // 1 / depth has to stay positive
  a.depth = a.rounded_depth(slope_x, slope_y, most);
  b.depth = b.rounded_depth(slope_x, slope_y, most);
  c.depth = c.rounded_depth(slope_x, slope_y, most);
}

/// @param swap  lanes whose second and third corners were exchanged
template <bool kDepth, bool kExact>
CornerDepths<kDepth> corner_depths(bool perspective, const PixelVertices& vertices,
                                   const CornerArrays& corners, int i, const Ints& swap) {
  if constexpr (kExact) {
    auto [a, b, c] = plane_corners(vertices, corners, i);
    stay_on_plane(a, b, c, perspective);
    return {{swap ? b.depth : c.depth, a.depth, swap ? c.depth : b.depth}, perspective};
  } else if constexpr (kDepth) {
    const auto [a, b, c] = depths_at(vertices, corners, i);
    return {{swap ? b : c, a, swap ? c : b}, perspective};
  } else {
    return {};
  }
}

/// @param swap  front faces, where both faces are drawn
template <class Pixel>
Source<Pixel> source_of(const ClusterDraw<Pixel>& draw, const ClusterProjection& projection,
                        const Cluster& cluster, const std::int32_t* numbers, const Ints& swap) {
  if constexpr (kCounts<Pixel>) {
    return {1 + 2 * swap};
  } else if constexpr (kSums<Pixel>) {
    return {draw.brightness, projection.start_mm, draw.brightness.is_signed ? swap : Ints{}};
  } else if constexpr (sizeof(Pixel) == sizeof(std::uint64_t)) {
    const std::uint32_t first = draw.brightness.first_triangle + cluster.first_corner / 3;
    return {projection.start_mm, ~(load<Ints>(numbers) + static_cast<std::int32_t>(first))};
  } else if constexpr (kDeep<Pixel>) {
    return {projection.z_of_depth, draw.brightness};
  } else {
    return {draw.brightness.rank};
  }
}

/// What of the target lies right of and below a cluster's origin.
template <class Pixel, bool kCut>
Canvas<Pixel, kCut> canvas_at(const ClusterDraw<Pixel>& draw, const PixelTarget<Pixel>& target,
                              const PixelVertices& vertices) {
  const Canvas<Pixel, kCut> whole{target.pixels, kCut ? draw.ends->of_pixels_mm : nullptr};
  return whole.at(static_cast<std::ptrdiff_t>(vertices.origin_y) * target.width +
                  vertices.origin_x);
}

template <class Pixel, bool kCut>
RaisedPixels<Pixel, kCut> raised_by(const ClusterDraw<Pixel>& draw,
                                    const Canvas<Pixel, kCut>& origin, int stride) {
  if constexpr (RaisedPixels<Pixel, kCut>::kKnown) {
    return {origin.pixels, stride, draw.brightness.rank};
  } else {
    return {};
  }
}

template <bool kCut, class Pixel>
void draw_triangles(const Kernel<Pixel>& kernel, const ClusterDraw<Pixel>& draw,
                    const Cluster& cluster, const PixelVertices& vertices) {
  const Clip clip = clip_of(kernel, vertices);
  const ClusterProjection& projection = kernel.projection;
  const auto origin = canvas_at<Pixel, kCut>(draw, kernel.target, vertices);
  const std::uint8_t* first = draw.corners + cluster.first_corner;
  const int count = cluster.triangles;
  // Front faces are counter-clockwise, which has a negative area where y points down.
  const std::ptrdiff_t count_wide = count;
  const std::ptrdiff_t second = draw.faces == Faces::Front ? 2 * count_wide : count_wide;
  const CornerArrays corners{first, first + second, first + 3 * count_wide - second};
  const bool both_faces = draw.faces == Faces::Both;
  const auto raised = raised_by(draw, origin, kernel.target.width);
  Candidates listed;
  list_candidates(vertices, corners, count, both_faces, clip, raised, listed);
  const CornerArrays left{listed.corners[0], listed.corners[1], listed.corners[2]};
  for (int i = 0; i < listed.count; i += kLanes) {
    Triangles triangles = gather(vertices, left, i);
    const Ints swap = orient(triangles, both_faces).swapped;
    constexpr bool kDepth = kCut || kDeep<Pixel>;
    const Shade<Pixel, kCut> shade{
        corner_depths<kDepth, kOnPlane<Pixel>>(projection.perspective, vertices, left, i, swap),
        source_of(draw, projection, cluster, listed.numbers + i, swap), projection.start_mm};
    cover(triangles, listed.count - i, clip, origin, kernel.target.width, shade);
  }
}

/// False if the cluster is too large.
template <bool kCut, class Pixel>
bool draw_cluster(const Kernel<Pixel>& kernel, const ClusterDraw<Pixel>& draw,
                  const Cluster& cluster, PixelVertices& vertices) {
  const float* positions = draw.positions + cluster.first_position;
  if (!project < kCut || kDeep < Pixel >> (kernel, positions, cluster.vertices, vertices))
    return false;
  draw_triangles<kCut>(kernel, draw, cluster, vertices);
  return true;
}

template <class Pixel>
bool may_show(const Kernel<Pixel>& kernel, const ClusterDraw<Pixel>& draw, const Cluster& cluster) {
  return !outside(kernel, cluster) &&
         !(draw.faces == Faces::Front && turned_away(kernel, cluster, 1.0F)) &&
         !(draw.faces == Faces::Back && turned_away(kernel, cluster, -1.0F)) &&
         near_plane(kernel, cluster) != Reach::Behind &&
         part_of(kernel, draw, cluster) != Part::None;
}

/// Asks for the memory of a cluster that is drawn next. Inlined first of all: the compiler takes a
/// function that does no more than this for one without effect, and leaves its calls out.
template <class Pixel>
[[gnu::always_inline]] inline void fetch(const ClusterDraw<Pixel>& draw, const Cluster& cluster) {
  constexpr int kLine = 64;
  const float* positions = draw.positions + cluster.first_position;
  for (int i = 0; i < 3 * cluster.vertices; i += kLine / 4) __builtin_prefetch(positions + i);
  const std::uint8_t* corners = draw.corners + cluster.first_corner;
  for (int i = 0; i < 3 * cluster.triangles; i += kLine) __builtin_prefetch(corners + i);
}

/// The first cluster from `i` on that may show, which is drawn soon.
template <class Pixel>
std::size_t next_shown(const Kernel<Pixel>& kernel, const ClusterDraw<Pixel>& draw, std::size_t i) {
  while (i < draw.count && !may_show(kernel, draw, draw.clusters[i])) ++i;
  if (i < draw.count) fetch(draw, draw.clusters[i]);
  return i;
}

template <class Pixel>
KernelResult draw_clusters(const ClusterDraw<Pixel>& draw, const ClusterProjection& projection,
                           const PixelTarget<Pixel>& target, std::uint32_t* too_large) {
  const Kernel<Pixel> kernel = make_kernel(projection, target);
  KernelResult result;
  PixelVertices vertices;
  std::size_t next = next_shown(kernel, draw, 0);
  while (next < draw.count) {
    const std::size_t i = next;
    next = next_shown(kernel, draw, i + 1);
    const Cluster& cluster = draw.clusters[i];
    result.triangles += cluster.triangles;
    bool drawn = false;
    if (near_plane(kernel, cluster) == Reach::Beyond) {
      drawn = part_of(kernel, draw, cluster) == Part::All
                  ? draw_cluster<kCounts<Pixel>>(kernel, draw, cluster, vertices)
                  : draw_cluster<true>(kernel, draw, cluster, vertices);
    }
    if (!drawn) too_large[result.too_large++] = static_cast<std::uint32_t>(i);
  }
  return result;
}

}  // namespace

template <class Pixel>
DrawClusters<Pixel> draw_clusters_of() noexcept {
  return &draw_clusters<Pixel>;
}

template DrawClusters<std::uint8_t> draw_clusters_of() noexcept;
template DrawClusters<std::uint16_t> draw_clusters_of() noexcept;
template DrawClusters<float> draw_clusters_of() noexcept;
template DrawClusters<std::int32_t> draw_clusters_of() noexcept;
template DrawClusters<std::int64_t> draw_clusters_of() noexcept;
template DrawClusters<std::uint64_t> draw_clusters_of() noexcept;

}  // namespace nacre::NACRE_KERNEL
