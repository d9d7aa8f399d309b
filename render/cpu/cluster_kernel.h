#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <type_traits>

#include "core/instruction_set.h"
#include "render/cpu/mesh_clusters.h"
#include "render/plan.h"

namespace nacre {

/// Sub-pixel steps: vertices are rounded to 1/256 of a pixel, as GL rasterisers do.
inline constexpr int kSubpixelBits = 8;
inline constexpr int kSubpixels = 1 << kSubpixelBits;

/// The largest side, in pixels, of what the kernels draw: differences of corners fit 16 bits, and
/// twice an area 32.
inline constexpr float kKernelSide = 126.0F;

/// Largest target side: rounding to sub-pixels is exact for coordinates below 2^22 of them.
inline constexpr int kMaxKernelTarget = 8192;

/// How positions become pixels of a target, in floats as GL has it. Their depth, mm along the
/// viewing direction, is w in perspective, whose inverse is linear over the pixels of a triangle.
struct ClusterProjection {
  glm::vec4 row_x{0.0F};  ///< rows of `clip_from_local`
  glm::vec4 row_y{0.0F};
  glm::vec4 row_w{0.0F};
  glm::vec4 row_depth{0.0F};   ///< depth beyond the start of the rays; without perspective only
  glm::vec2 z_of_depth{0.0F};  ///< z = x + y depth, as in `depth_z`
  float start_mm = 0.0F;       ///< depth where rays start: 0 without perspective
  glm::vec3 view_from{0.0F};   ///< viewing direction, or the eye (perspective), local
  float near_mm = 0.0F;        ///< of the near plane; perspective only
  bool perspective = false;
};

/// Where the rays of a target's pixels end.
struct RayEnds {
  const float* of_pixels_mm = nullptr;  ///< beyond the start of the rays
  float least_mm = 0.0F;                ///< of them
  float greatest_mm = 0.0F;
};

/// Pixels beyond the last of a target that kernels may look at.
inline constexpr std::size_t kPixelPadding = 16;

/// What the pixels of a target hold, of all that was drawn:
///
/// - bytes and words: the greatest rank;
/// - floats: the greatest emission;
/// - std::int32_t: a number of shells: back minus front faces beyond the ends of rays;
/// - std::int64_t: a sum of what crossings add, in steps: whole numbers, which add up to the same
///   in any order;
/// - std::uint64_t: the nearest triangle, as `key_of` makes it.
///
/// All start at 0. What is drawn in several targets is merged by the maximum; numbers and sums are
/// added.
template <class Pixel>
struct PixelTarget {
  Pixel* pixels = nullptr;  ///< width * height, and `kPixelPadding` that may be looked at
  int width = 0;
  int height = 0;
};

/// Whether pixels hold numbers of shells.
template <class Pixel>
inline constexpr bool kCounts = std::is_same_v<Pixel, std::int32_t>;

/// Whether they hold sums.
template <class Pixel>
inline constexpr bool kSums = std::is_same_v<Pixel, std::int64_t>;

/// Whether they take the depth of the very triangle, not of the one with rounded corners: what adds
/// up, and where tools end rays. Both are a few more steps a triangle.
template <class Pixel>
inline constexpr bool kOnPlane = kSums<Pixel> || std::is_same_v<Pixel, std::uint64_t>;

/// What a shell puts into pixels: a rank, the same everywhere, ...
template <class Pixel>
struct Brightness {
  Pixel rank = 0;
};

/// ... or an emission that goes linearly with depth z from `at_near` (z = 1) to `at_far` (z = 0).
template <>
struct Brightness<float> {
  float at_near = 0.0F;
  float at_far = 0.0F;
};

/// ... or 1 for back faces, -1 for front faces ...
template <>
struct Brightness<std::int32_t> {};

/// ... or, for sums, steps at a depth d beyond the start of the ray, from 0 to `most_depth_mm`: the
/// whole part of constant + d (linear + square d), at most `kMostSteps` ...
template <>
struct Brightness<std::int64_t> {
  float constant = 0.0F;
  float linear = 0.0F;
  float square = 0.0F;
  /// Of the scene. Triangles thinner than the rounding of their corners may be crossed beyond them.
  float most_depth_mm = 0.0F;
  /// An integral: front faces take off what back faces add, and crossings before the start or
  /// beyond the end of a ray count as there. Else each crossing between them adds the same way.
  bool is_signed = false;
};

/// Steps of one crossing: 32 bits hold them with room to spare.
inline constexpr float kMostSteps = 0x1p29F;

/// ... or which triangle it is: this number plus its place among the corners of its mesh.
template <>
struct Brightness<std::uint64_t> {
  std::uint32_t first_triangle = 0;
};

/// A pixel that holds a triangle and its depth beyond the start of the ray: the greater, the
/// nearer, and of those at one depth, the one with the least number. Never 0 for a finite depth.
struct NearestKey {
  float depth_mm = 0.0F;
  std::uint32_t triangle = 0;
};
std::uint64_t key_of(const NearestKey& nearest) noexcept;
NearestKey nearest_of(std::uint64_t key) noexcept;

/// Some clusters of one shell, to be drawn alike.
template <class Pixel>
struct ClusterDraw {
  const Cluster* clusters = nullptr;  ///< the first; the arrays are those of `MeshClusters`
  std::size_t count = 0;
  const float* positions = nullptr;
  const std::uint8_t* corners = nullptr;
  Faces faces = Faces::Front;
  Brightness<Pixel> brightness;
  /// Ranks, emissions and sums show between start and end of rays only, if there are any; numbers
  /// of shells need them.
  const RayEnds* ends = nullptr;
};

/// What a kernel left, and what it did.
struct KernelResult {
  std::size_t triangles = 0;  ///< looked at, padding included
  std::size_t too_large = 0;  ///< clusters left to `draw_large_cluster`
};

/// Draws clusters: rejects what is outside the target or turned away, projects, rounds to
/// sub-pixels, and covers the pixel centres inside each triangle, those on its upper and left edges
/// included. All in integers after rounding: triangles that share an edge cover no centre on it
/// twice, and none is left out. Depths are those of the pixel's centre on the
/// triangle's plane.
///
/// Clusters that reach the near plane or are larger than `kKernelSide` are not drawn but listed.
///
/// @param too_large  room for `draw.count` indices of clusters
template <class Pixel>
using DrawClusters = KernelResult (*)(const ClusterDraw<Pixel>& draw,
                                      const ClusterProjection& projection,
                                      const PixelTarget<Pixel>& target, std::uint32_t* too_large);

/// The kernel for a set.
/// @tparam Pixel  what targets can hold, see `PixelTarget`
/// @pre  the processor has it
template <class Pixel>
DrawClusters<Pixel> draw_clusters_for(InstructionSet set) noexcept;
extern template DrawClusters<std::uint8_t> draw_clusters_for(InstructionSet set) noexcept;
extern template DrawClusters<std::uint16_t> draw_clusters_for(InstructionSet set) noexcept;
extern template DrawClusters<float> draw_clusters_for(InstructionSet set) noexcept;
extern template DrawClusters<std::int32_t> draw_clusters_for(InstructionSet set) noexcept;
extern template DrawClusters<std::int64_t> draw_clusters_for(InstructionSet set) noexcept;
extern template DrawClusters<std::uint64_t> draw_clusters_for(InstructionSet set) noexcept;

}  // namespace nacre
