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

inline Floats gather_depths(const float* depths, const std::uint8_t* corners,
                            const std::uint8_t* list) {
  Floats gathered;
  for (int i = 0; i < kLanes; ++i) gathered[i] = depths[corners[list[i]]];
  return gathered;
}

/// @param swap  lanes whose second and third corners were exchanged
template <class Pixel>
Shade<Pixel> shade_of(const ClusterDraw<Pixel>& draw, const ClusterProjection& projection,
                      const PixelVertices& vertices, const CornerArrays& corners,
                      const std::uint8_t* list, const Ints& swap) {
  if constexpr (kCued<Pixel>) {
    const Floats a = gather_depths(vertices.depth, corners.first, list);
    const Floats b = gather_depths(vertices.depth, corners.second, list);
    const Floats c = gather_depths(vertices.depth, corners.third, list);
    return {{swap ? b : c, a, swap ? c : b},
            projection.z_of_w,
            projection.perspective,
            draw.brightness};
  } else {
    return {draw.brightness.rank};
  }
}

template <class Pixel>
void draw_triangles(const Kernel<Pixel>& kernel, const ClusterDraw<Pixel>& draw,
                    const Cluster& cluster, const PixelVertices& vertices) {
  const Clip clip = clip_of(kernel, vertices);
  const int stride = kernel.target.width;
  Pixel* origin = kernel.target.pixels + static_cast<std::ptrdiff_t>(vertices.origin_y) * stride +
                  vertices.origin_x;
  const std::uint8_t* first = draw.corners + cluster.first_corner;
  const int count = cluster.triangles;
  // Front faces are counter-clockwise, which has a negative area where y points down.
  const std::ptrdiff_t count_wide = count;
  const std::ptrdiff_t second = draw.faces == Faces::Front ? 2 * count_wide : count_wide;
  const CornerArrays corners{first, first + second, first + 3 * count_wide - second};
  const bool both_faces = draw.faces == Faces::Both;
  // NOLINTNEXTLINE(modernize-avoid-c-arrays)
  alignas(64) std::uint8_t list[kClusterTriangles + kLanePadding + kLanes];
  const int listed = list_candidates(vertices, corners, count, both_faces, clip, list);
  for (int i = 0; i < listed; i += kLanes) {
    Triangles triangles = gather_listed(vertices.xy, corners, list + i);
    const Ints swap = orient(triangles, both_faces).swapped;
    cover(triangles, listed - i, clip, origin, stride,
          shade_of(draw, kernel.projection, vertices, corners, list + i, swap));
  }
}

template <class Pixel>
KernelResult draw_clusters(const ClusterDraw<Pixel>& draw, const ClusterProjection& projection,
                           const PixelTarget<Pixel>& target, std::uint32_t* too_large) {
  const Kernel<Pixel> kernel = make_kernel(projection, target);
  KernelResult result;
  PixelVertices vertices;
  for (std::size_t i = 0; i < draw.count; ++i) {
    const Cluster& cluster = draw.clusters[i];
    if (outside(kernel, cluster)) continue;
    if (draw.faces == Faces::Front && turned_away(kernel, cluster, 1.0F)) continue;
    if (draw.faces == Faces::Back && turned_away(kernel, cluster, -1.0F)) continue;
    const Reach reach = near_plane(kernel, cluster);
    if (reach == Reach::Behind) continue;
    result.triangles += cluster.triangles;
    if (reach == Reach::Beyond &&
        project(kernel, draw.positions + cluster.first_position, cluster.vertices, vertices)) {
      draw_triangles(kernel, draw, cluster, vertices);
    } else {
      too_large[result.too_large++] = static_cast<std::uint32_t>(i);
    }
  }
  return result;
}

}  // namespace

DrawClusters<std::uint8_t> draw_clusters_8() noexcept { return &draw_clusters<std::uint8_t>; }
DrawClusters<std::uint16_t> draw_clusters_16() noexcept { return &draw_clusters<std::uint16_t>; }
DrawClusters<float> draw_clusters_cued() noexcept { return &draw_clusters<float>; }

}  // namespace nacre::NACRE_KERNEL
