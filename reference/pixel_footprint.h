#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/camera.h"
#include "reference/pixel_range.h"

namespace nacre {

/// Which pixels' rays may meet a triangle in front of the eye: a rectangle around its projection,
/// widened by more than rounding moves it. What it leaves out no ray of this picture meets.
///
/// In perspective a triangle that reaches behind the eye is cut a hundred-thousandth of the
/// sphere's radius before it; one that comes nearer to the eye than that counts for all pixels.
class PixelFootprint {
 public:
  explicit PixelFootprint(const Camera& camera);

  PixelRange operator()(const std::array<glm::dvec3, 3>& corners_mm) const;

 private:
  struct Bounds;

  /// Offsets to the right and upwards, and the depth before the eye (perspective), mm.
  glm::dvec3 in_view(const glm::dvec3& p_mm) const;
  glm::dvec2 on_picture(const glm::dvec3& view) const;
  void include_before_eye(const std::array<glm::dvec3, 3>& view, Bounds& bounds) const;
  PixelRange all_pixels() const;

  Camera camera_;
  glm::dvec3 origin_mm_;   ///< the eye, or the target
  double nearest_mm_ = 0;  ///< where triangles are cut; perspective only
  double pixels_ = 0;      ///< half the shorter side in pixels over half the picture's extent
  double hair_pixels_ = 0;
  double hair_mm_ = 0;
};

}  // namespace nacre
