#include "reference/triangle_bins.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace nacre {
namespace {

/// Adds a triangle to the lists of the bands that its pixels touch.
void add(const BinnedTriangle& found, const TriangleBins::Rows& rows,
         std::vector<std::vector<BinnedTriangle>>& lists) {
  const int first = std::max(found.pixels.first.y, rows.first_row) - rows.first_row;
  const int last = std::min(found.pixels.last.y, rows.end_row - 1) - rows.first_row;
  if (first > last) return;
  for (int band = first / rows.band_rows; band <= last / rows.band_rows; ++band) {
    BinnedTriangle part = found;
    const int begin = rows.first_row + band * rows.band_rows;
    part.pixels.first.y = std::max(found.pixels.first.y, begin);
    part.pixels.last.y =
        std::min({found.pixels.last.y, begin + rows.band_rows - 1, rows.end_row - 1});
    lists[static_cast<std::size_t>(band)].push_back(part);
  }
}

}  // namespace

TriangleBins::TriangleBins(const TriangleMesh& mesh, const glm::dvec3& offset_mm,
                           const PixelFootprint& footprint, const Rows& rows)
    : bands_((rows.end_row - rows.first_row + rows.band_rows - 1) / rows.band_rows) {
  constexpr std::size_t kPartTriangles = 1U << 14U;
  const std::size_t count = mesh.triangles.size();
  parts_.resize((count + kPartTriangles - 1) / kPartTriangles);
  tbb::parallel_for(std::size_t{0}, parts_.size(), [&](std::size_t index) {
    Part& part = parts_[index];
    part.resize(static_cast<std::size_t>(bands_));
    const std::size_t end = std::min(count, (index + 1) * kPartTriangles);
    for (std::size_t i = index * kPartTriangles; i < end; ++i) {
      const glm::uvec3& t = mesh.triangles[i];
      const BinnedTriangle found{static_cast<std::uint32_t>(i),
                                 footprint({offset_mm + glm::dvec3(mesh.positions[t.x]),
                                            offset_mm + glm::dvec3(mesh.positions[t.y]),
                                            offset_mm + glm::dvec3(mesh.positions[t.z])})};
      if (!found.pixels.empty()) add(found, rows, part);
    }
  });
}

}  // namespace nacre
