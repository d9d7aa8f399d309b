#pragma once

#include <glm/vec3.hpp>
#include <utility>

#include "core/tolerance_weight.h"
#include "core/triangle_mesh.h"
#include "shells/level_field.h"
#include "shells/surface_field.h"

namespace nacre {

/// The mean length of a field's gradient over a surface, per mm; points that may not move are left
/// out. 0 where there are none.
double mean_slope(const TriangleMesh& surface, const SurfaceField& field);

/// A level field whose errors count by what a maximum projection shows of them.
///
/// Where the contour of a shell is displaced by d along a picture, pixels beside it show the wrong
/// one of two layers: their squared error grows by layer * e * d = layer * e^2 / slope for an
/// emission error e. The same error shows over more pixels where the field is shallow, so that it
/// counts by slope^-1/2: from 1 in the steepest places (9 times the mean slope and more) to 9 in
/// the shallowest (a ninth of it and less), and 3 at the mean.
///
/// No error counts less than it is, and one beyond `tolerance` counts 9 times what it is wherever
/// it lies: more than any within it. A surface whose weighted error stays within the larger of
/// the tolerance and what it was therefore keeps its error itself within the larger of these, too.
class PictureWeight {
 public:
  /// @param mean_slope  of the field over the surface; 0 leaves errors as they are
  PictureWeight(LevelField field, double mean_slope, double tolerance)
      : field_(std::move(field)),
        squared_mean_slope_(mean_slope * mean_slope),
        tolerance_(tolerance) {}

  FieldSample operator()(const glm::dvec3& p_mm) const noexcept;

 private:
  LevelField field_;
  double squared_mean_slope_;
  double tolerance_;
};

}  // namespace nacre
