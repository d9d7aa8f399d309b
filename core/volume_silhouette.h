#pragma once

#include <algorithm>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/camera.h"
#include "core/image.h"

namespace nacre {

/// Columns of one row of a picture: first <= x < end; none where they are equal.
struct PixelSpan {
  int first = 0;
  int end = 0;
};

/// The pixels whose rays meet a volume's box, row by row: outside of them a picture of the volume
/// shows nothing.
///
/// The box is convex, and so is its picture: the hull of its projected corners; in perspective of
/// what of the box lies before the eye, so that an eye beside or within the box is no other case.
/// A pixel belongs to it if its centre does, to within rounding.
///
/// @param dims, world_from_voxel  of the volume, see `voxel_box`
/// @return as many spans as the picture has rows
std::vector<PixelSpan> volume_silhouette(const Camera& camera, const glm::i64vec3& dims,
                                         const glm::dmat4& world_from_voxel);

/// Of spans of rays, an odd number `per_pixel` of them a pixel along each axis, those of the pixels
/// whose middle rays they hold.
std::vector<PixelSpan> middle_spans(std::span<const PixelSpan> spans, int per_pixel);

/// Blacks the pixels outside of the spans.
/// @param width  of the picture
/// @pre          `spans` are as many as the picture has rows, or none: then it stays as it is
template <class Pixel>
void black_outside(std::span<const PixelSpan> spans, int width, std::span<Pixel> pixels) {
  auto row = pixels.begin();
  for (const PixelSpan& span : spans) {
    std::fill(row, row + span.first, Pixel{0});
    std::fill(row + span.end, row + width, Pixel{0});
    row += width;
  }
}

inline void black_outside(std::span<const PixelSpan> spans, Image& picture) {
  black_outside<float>(spans, picture.width, picture.pixels);
}

}  // namespace nacre
