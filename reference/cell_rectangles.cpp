#include "reference/cell_rectangles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace nacre {
namespace {

struct Bounds {
  double least;
  double greatest;
};

/// Bounds of a / w, w > 0.
Bounds quotient(const Bounds& a, const Bounds& w) {
  return {a.least / (a.least < 0.0 ? w.least : w.greatest),
          a.greatest / (a.greatest < 0.0 ? w.greatest : w.least)};
}

/// First and past-the-last pixel of [begin, end) with its centre within the bounds, or a hair
/// outside.
void cut(const Bounds& bounds, int& begin, int& end) {
  constexpr double kHair = 1e-6;  // pixels: far above the rounding of 1e5 of them
  const auto pixel = [&](double p) {
    return static_cast<int>(std::clamp<double>(p, begin - 1.0, end + 1.0));
  };
  // A cast rounds towards zero: of what is below it only -1 is left, which is cut.
  begin = std::max(begin, pixel(bounds.least + (0.5 - kHair)));
  end = std::min(end, pixel(bounds.greatest + (0.5 + kHair)));
}

}  // namespace

CellRectangles::Affine CellRectangles::affine(const WalkField& field, const glm::dvec3& axis,
                                              const glm::dvec3& from_mm, double scale) {
  const glm::dmat3& m = field.frame.world_from_cell;
  Affine result;
  result.rise =
      scale * glm::dvec3(glm::dot(axis, m[0]), glm::dot(axis, m[1]), glm::dot(axis, m[2]));
  result.at_origin = scale * glm::dot(axis, field.frame.center_mm - from_mm) -
                     glm::dot(result.rise, field.frame.center_cell);
  const glm::dvec3 size = glm::abs(result.rise);
  result.half_cell = 0.5 * (size.x + size.y + size.z);
  return result;
}

CellRectangles::CellRectangles(const WalkField& field, const Camera& camera)
    : center_px_(0.5 * glm::dvec2(camera.size)), perspective_(camera.perspective) {
  const double scale = 0.5 * std::min(camera.size.x, camera.size.y) / camera.half_extent;
  const glm::dvec3 from = camera.perspective ? eye_mm(camera) : camera.target_mm;
  x_ = affine(field, camera.right, from, scale);
  y_ = affine(field, camera.up, from, scale);
  w_ = affine(field, camera.forward, from, 1.0);
}

PixelRectangle CellRectangles::of(const glm::ivec3& first_cell, int side,
                                  const PixelRectangle& frame) const {
  const glm::dvec3 center = glm::dvec3(first_cell) + 0.5 * side;
  const auto bounds = [&](const Affine& f) {
    const double value = f(center);
    return Bounds{value - side * f.half_cell, value + side * f.half_cell};
  };
  Bounds x = bounds(x_);
  Bounds y = bounds(y_);
  if (perspective_) {
    const Bounds w = bounds(w_);
    if (w.greatest <= 0.0) return {};
    // The eye is within the cube or beside it: anywhere.
    if (w.least <= 1e-9 * w.greatest) return frame;
    x = quotient(x, w);
    y = quotient(y, w);
  }
  PixelRectangle rectangle = frame;
  cut({center_px_.x + x.least, center_px_.x + x.greatest}, rectangle.x0, rectangle.x1);
  cut({center_px_.y - y.greatest, center_px_.y - y.least}, rectangle.y0, rectangle.y1);
  return rectangle;
}

}  // namespace nacre
