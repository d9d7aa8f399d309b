#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "reference/pixel_footprint.h"

namespace nacre {

/// A triangle and the pixels of a band whose rays may meet it.
struct BinnedTriangle {
  std::uint32_t triangle = 0;
  PixelRange pixels;
};

/// The triangles of a mesh sorted into bands of the picture's rows, in parallel: each band can then
/// be worked on by itself, and finds its triangles in the mesh's order.
///
/// Triangles that lie between the pixels' centres (most of a fine mesh) are in no band.
class TriangleBins {
 public:
  /// Bands of `band_rows` rows from `first_row` on, up to `end_row`.
  struct Rows {
    int first_row = 0;
    int end_row = 0;
    int band_rows = 8;
  };

  /// @param offset_mm  added to the mesh's positions: LPS mm
  TriangleBins(const TriangleMesh& mesh, const glm::dvec3& offset_mm,
               const PixelFootprint& footprint, const Rows& rows);

  int band_count() const { return bands_; }

  /// Parts of a band's list; one after the other they are in the mesh's order.
  std::size_t part_count() const { return parts_.size(); }
  std::span<const BinnedTriangle> part(int band, std::size_t index) const {
    return parts_[index][static_cast<std::size_t>(band)];
  }

 private:
  using Part = std::vector<std::vector<BinnedTriangle>>;  ///< a list for each band

  int bands_;
  std::vector<Part> parts_;
};

}  // namespace nacre
