#pragma once

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
/// A pixel belongs to it if its centre does, to within rounding (some 1e-9 pixels, outwards).
///
/// @param dims, world_from_voxel  of the volume, see `voxel_box`
/// @return as many spans as the picture has rows
std::vector<PixelSpan> volume_silhouette(const Camera& camera, const glm::i64vec3& dims,
                                         const glm::dmat4& world_from_voxel);

/// Blacks the pixels outside of the spans.
/// @pre  `spans` are as many as the picture has rows, or none: then the picture stays as it is
void black_outside(std::span<const PixelSpan> spans, Image& picture);

}  // namespace nacre
