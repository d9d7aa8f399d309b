#pragma once

#include <algorithm>
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/camera.h"
#include "reference/bright_bricks.h"
#include "reference/pixel_range.h"
#include "reference/walk_field.h"

namespace nacre {

/// Where cubes of cells lie in the picture of a camera.
///
/// A point p in cell coordinates is seen at (center_px.x + X/W, center_px.y - Y/W), with X, Y and W
/// affine in p (W = 1 in an orthographic picture). A cube's X, Y and W are within an interval each;
/// the quotient's bounds bound its picture.
class CellRectangles {
 public:
  CellRectangles(const WalkField& field, const Camera& camera);

  /// The pixels whose centres a cube of cells may cover, within `frame`: a rectangle around them,
  /// never smaller. Nothing behind the eye.
  ///
  /// @param first_cell  the cube's lower corner
  /// @param side        cells along its edge
  PixelRange of(const glm::ivec3& first_cell, int side, const PixelRange& frame) const;

  /// The same of each cell of a brick.
  class OfBrick {
   public:
    /// @param all  outlives this object
    OfBrick(const CellRectangles& all, const glm::ivec3& first_cell, const PixelRange& frame)
        : all_(all),
          first_cell_(first_cell),
          frame_(frame),
          x_(all.center_px_.x + all.x_(glm::dvec3(first_cell))),
          y_(all.center_px_.y - all.y_(glm::dvec3(first_cell))) {}

    /// The pixels that cell `index` (x + 4 y + 16 z) of the brick may cover.
    PixelRange cell(int index) const {
      if (all_.perspective_) {
        return all_.of(first_cell_ + glm::ivec3(index & 3, (index >> 2) & 3, index >> 4), 1,
                       frame_);
      }
      const auto i = static_cast<std::size_t>(index);
      return around(x_ + all_.cell_x_[i], y_ - all_.cell_y_[i], all_.x_.half_cell,
                    all_.y_.half_cell, frame_);
    }

   private:
    const CellRectangles& all_;
    glm::ivec3 first_cell_;
    PixelRange frame_;
    double x_;
    double y_;
  };

 private:
  struct Affine {
    double at_origin = 0.0;
    glm::dvec3 rise{0.0};
    double half_cell = 0.0;  ///< the most it changes within half a cell's edge from its centre

    double operator()(const glm::dvec3& p) const {
      return at_origin + (rise.x * p.x + (rise.y * p.y + rise.z * p.z));
    }
  };
  static Affine affine(const WalkField& field, const glm::dvec3& axis, const glm::dvec3& from_mm,
                       double scale);

  /// Pixels of `frame` with their centres within a box about (x, y), or a hair outside.
  static PixelRange around(double x, double y, double half_x, double half_y,
                           const PixelRange& frame) {
    constexpr double kHair = 1e-6;  // pixels: far above the rounding of 1e5 of them
    // A cast rounds towards zero: what is below it lies before the frame in any case.
    const auto pixel = [](double p, int from, int to) {
      return static_cast<int>(std::clamp<double>(p, from, to));
    };
    const glm::ivec2& from = frame.first;
    const glm::ivec2 end = frame.last + 1;
    return {{pixel(x - half_x + (0.5 - kHair), from.x, end.x),
             pixel(y - half_y + (0.5 - kHair), from.y, end.y)},
            {pixel(x + half_x + (0.5 + kHair), from.x, end.x) - 1,
             pixel(y + half_y + (0.5 + kHair), from.y, end.y) - 1}};
  }

  glm::dvec2 center_px_;
  Affine x_;
  Affine y_;
  Affine w_;
  bool perspective_;
  static constexpr int kBrick = BrightBricks::kSide;
  static constexpr std::size_t kBrickCells = std::size_t{kBrick} * kBrick * kBrick;
  std::array<double, kBrickCells> cell_x_{};  ///< of a cell's centre, from the brick
  std::array<double, kBrickCells> cell_y_{};
};

/// Where each bright brick lies in the picture. On all cores.
std::vector<PixelRange> rectangles_of(const BrightBricks& bright, const CellRectangles& rectangles,
                                      const glm::ivec2& size);

}  // namespace nacre
