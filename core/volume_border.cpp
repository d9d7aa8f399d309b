#include "core/volume_border.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

namespace nacre {
namespace {

// Voxels: the rounding of positions and matrices.
constexpr double kOnBorder = 1e-6;

}  // namespace

bool has_border(const VolumeFacts& volume) noexcept {
  if (!is_stated(volume)) return false;
  const double handed = handedness(volume.world_from_voxel);
  return std::isfinite(handed) && handed != 0.0;
}

VolumeBorder::VolumeBorder(const VolumeFacts& volume, const glm::dvec3& center_mm)
    : box_(voxel_box(volume.dims)),
      offset_mm_(center_mm - bounding_sphere(volume.dims, volume.world_from_voxel).center_mm),
      voxel_from_local_(voxel_from_local(volume.dims, volume.world_from_voxel)),
      local_from_voxel_(glm::inverse(voxel_from_local_)) {}

glm::vec3 VolumeBorder::operator()(const glm::vec3& p_mm) const {
  const glm::dvec3 p(voxel_from_local_ * glm::dvec4(glm::dvec3(p_mm) + offset_mm_, 1.0));
  bool is_beyond = false;
  for (int axis = 0; axis < 3; ++axis) {
    is_beyond =
        is_beyond || p[axis] < box_.lo[axis] - kOnBorder || p[axis] > box_.hi[axis] + kOnBorder;
  }
  if (!is_beyond) return p_mm;
  const glm::dvec3 moved = glm::clamp(p, box_.lo, box_.hi);
  return glm::vec3(glm::dvec3(local_from_voxel_ * glm::dvec4(moved, 1.0)) - offset_mm_);
}

std::optional<TriangleMesh> within_border(const ShellSet& set, const TriangleMesh& surface) {
  if (!has_border(set.volume)) return std::nullopt;
  const VolumeBorder border(set.volume, set.center_mm);
  std::optional<TriangleMesh> within;
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    const glm::vec3 moved = border(surface.positions[v]);
    if (moved == surface.positions[v]) continue;
    if (!within) within = surface;
    within->positions[v] = moved;
  }
  return within;
}

}  // namespace nacre
