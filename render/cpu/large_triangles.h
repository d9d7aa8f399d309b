#pragma once

#include "render/cpu/cluster_kernel.h"

namespace nacre {

/// Draws a cluster whatever its size and wherever it lies: what the kernels leave.
///
/// Triangles are clipped at the near plane and where they leave the range of 2^28 sub-pixels, in
/// double, rounded as the kernels round, and filled row by row between edges found by exact
/// division. The pixels are those of the kernels.
///
/// @param draw  its `clusters` point to the cluster; `count` is ignored
template <class Pixel>
void draw_large_cluster(const ClusterDraw<Pixel>& draw, const ClusterProjection& projection,
                        const PixelTarget<Pixel>& target);

}  // namespace nacre
