#include "reference/pixel_footprint.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace nacre {

/// Around points of the picture, in pixels.
struct PixelFootprint::Bounds {
  glm::dvec2 lo{std::numeric_limits<double>::infinity()};
  glm::dvec2 hi{-std::numeric_limits<double>::infinity()};

  void include(const glm::dvec2& p) {
    lo = glm::min(lo, p);
    hi = glm::max(hi, p);
  }
};

PixelFootprint::PixelFootprint(const Camera& camera)
    : camera_(camera),
      origin_mm_(camera.perspective ? eye_mm(camera) : camera.target_mm),
      pixels_(0.5 * std::min(camera.size.x, camera.size.y) / camera.half_extent) {
  const double radius = camera.sphere.radius_mm;
  const double farthest =
      glm::length(camera.sphere.center_mm) + glm::length(origin_mm_) + 2.0 * radius;
  nearest_mm_ = 1e-5 * radius;
  const double per_mm = camera.perspective ? pixels_ / nearest_mm_ : pixels_;
  hair_pixels_ = 1e-3 + 1e-13 * farthest * per_mm;
  // The part of a triangle before the cut that rays of this picture reach is this near to the eye.
  const double steepest = camera.half_extent * std::max(camera.size.x, camera.size.y) /
                          std::min(camera.size.x, camera.size.y);
  hair_mm_ = 2.0 * nearest_mm_ * (1.0 + 2.0 * steepest);
}

glm::dvec3 PixelFootprint::in_view(const glm::dvec3& p_mm) const {
  const glm::dvec3 offset = p_mm - origin_mm_;
  return {glm::dot(offset, camera_.right), glm::dot(offset, camera_.up),
          glm::dot(offset, camera_.forward)};
}

glm::dvec2 PixelFootprint::on_picture(const glm::dvec3& view) const {
  const double scale = camera_.perspective ? pixels_ / view.z : pixels_;
  return {0.5 * camera_.size.x + scale * view.x, 0.5 * camera_.size.y - scale * view.y};
}

PixelRange PixelFootprint::all_pixels() const { return {{0, 0}, camera_.size - 1}; }

void PixelFootprint::include_before_eye(const std::array<glm::dvec3, 3>& view,
                                        Bounds& bounds) const {
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3& p = view[i];
    const glm::dvec3& q = view[(i + 1) % 3];
    if (p.z >= nearest_mm_) bounds.include(on_picture(p));
    if ((p.z >= nearest_mm_) == (q.z >= nearest_mm_)) continue;
    const double part = (nearest_mm_ - p.z) / (q.z - p.z);
    glm::dvec3 cut = p + part * (q - p);
    cut.z = nearest_mm_;
    bounds.include(on_picture(cut));
  }
}

PixelRange PixelFootprint::operator()(const std::array<glm::dvec3, 3>& corners_mm) const {
  const std::array<glm::dvec3, 3> view{in_view(corners_mm[0]), in_view(corners_mm[1]),
                                       in_view(corners_mm[2])};
  Bounds bounds;
  const double nearest = std::min({view[0].z, view[1].z, view[2].z});
  if (!camera_.perspective || nearest >= nearest_mm_) {
    for (const glm::dvec3& p : view) bounds.include(on_picture(p));
  } else {
    const glm::dvec3 lo = glm::min(glm::min(view[0], view[1]), view[2]) - hair_mm_;
    const glm::dvec3 hi = glm::max(glm::max(view[0], view[1]), view[2]) + hair_mm_;
    if (lo.x <= 0 && lo.y <= 0 && lo.z <= 0 && hi.x >= 0 && hi.y >= 0 && hi.z >= 0) {
      return all_pixels();
    }
    include_before_eye(view, bounds);
  }
  // Clamped before they become integers.
  const glm::dvec2 end = glm::dvec2(camera_.size);
  const glm::dvec2 first = glm::ceil(bounds.lo - hair_pixels_ - 0.5);
  const glm::dvec2 last = glm::floor(bounds.hi + hair_pixels_ - 0.5);
  return {glm::ivec2(glm::clamp(first, glm::dvec2(0.0), end)),
          glm::ivec2(glm::clamp(last, glm::dvec2(-1.0), end - 1.0))};
}

}  // namespace nacre
