#include "reference/cell_rectangles.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

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
  for (int i = 0; i < kBrick * kBrick * kBrick; ++i) {
    const glm::dvec3 center =
        0.5 + glm::dvec3(i % kBrick, i / kBrick % kBrick, i / kBrick / kBrick);
    cell_x_[static_cast<std::size_t>(i)] = glm::dot(x_.rise, center);
    cell_y_[static_cast<std::size_t>(i)] = glm::dot(y_.rise, center);
  }
}

PixelRange CellRectangles::of(const glm::ivec3& first_cell, int side,
                              const PixelRange& frame) const {
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
  return around(center_px_.x + 0.5 * (x.least + x.greatest),
                center_px_.y - 0.5 * (y.least + y.greatest), 0.5 * (x.greatest - x.least),
                0.5 * (y.greatest - y.least), frame);
}

std::vector<PixelRange> rectangles_of(const BrightBricks& bright, const CellRectangles& rectangles,
                                      const glm::ivec2& size) {
  std::vector<PixelRange> result(bright.bricks.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, result.size()), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      result[i] =
          rectangles.of(bright.bricks[i].first_cell, BrightBricks::kSide, {{0, 0}, size - 1});
    }
  });
  return result;
}

}  // namespace nacre
