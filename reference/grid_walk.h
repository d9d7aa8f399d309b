#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

#include "reference/volume_bricks.h"

namespace nacre {

/// A line in cell coordinates (cell (0,0,0) spans [0,1]^3): position(t) = origin + t * direction,
/// with t in mm along the ray.
struct CellLine {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0};
};

/// A part of a line: t_enter <= t <= t_exit, in mm.
struct LineInterval {
  double t_enter;
  double t_exit;
};

/// The part of the interval where the line is inside [0, end] along one axis.
inline LineInterval clip_axis(const CellLine& line, int axis, double end, LineInterval interval) {
  const double t0 = -line.origin[axis] / line.direction[axis];
  const double t1 = (end - line.origin[axis]) / line.direction[axis];
  return {std::max(interval.t_enter, std::min(t0, t1)),
          std::min(interval.t_exit, std::max(t0, t1))};
}

/// The part of the interval that lies inside the grid [0, cells], borders included.
///
/// A line in a border plane counts as inside, so that a ray that grazes the volume sees its face.
/// Lines that run along a border plane to rounding (within a hair over their whole way) are put
/// into it; any other line is clipped exactly.
inline std::optional<LineInterval> clip_to_grid(CellLine& line, const glm::i64vec3& cells,
                                                LineInterval interval) {
  constexpr double kAlong = 1e-10;  // slope against the steepest axis
  constexpr double kHair = 1e-11;   // cells: the rounding of positions some 1e4 cells away
  const glm::dvec3 steepness = glm::abs(line.direction);
  const double along = kAlong * std::max({steepness.x, steepness.y, steepness.z});
  for (int axis = 0; axis < 3; ++axis) {
    if (steepness[axis] > along) {
      interval = clip_axis(line, axis, static_cast<double>(cells[axis]), interval);
    }
  }
  if (!(interval.t_enter < interval.t_exit)) return std::nullopt;

  for (int axis = 0; axis < 3; ++axis) {
    if (steepness[axis] > along) continue;
    const auto end = static_cast<double>(cells[axis]);
    const double first = line.origin[axis] + interval.t_enter * line.direction[axis];
    const double last = line.origin[axis] + interval.t_exit * line.direction[axis];
    const auto [least, greatest] = std::minmax(first, last);
    if (least >= 0.0 && greatest <= end) continue;
    if (least >= -kHair * end && greatest <= end + kHair * end) {
      line.origin[axis] = std::clamp(first, 0.0, end);
      line.direction[axis] = 0.0;
      continue;
    }
    if (line.direction[axis] == 0.0) return std::nullopt;
    interval = clip_axis(line, axis, end, interval);
  }
  if (!(interval.t_enter < interval.t_exit)) return std::nullopt;
  return interval;
}

/// One cell that a line passes: where it is, and where the line enters and leaves it.
struct CellPassage {
  glm::i64vec3 cell;
  glm::dvec3 p_enter;  ///< relative to the cell's lower corner, in [0, 1]^3
  glm::dvec3 p_exit;
  double length_mm;
};

/// Walks the cells of a grid along a line, from near to far, a brick at a time.
///
/// Planes are found from integer indices, never by adding steps, so that no error builds up, and a
/// cell once left is not entered again: each part of the line belongs to exactly one passage. Rays
/// along faces and edges take one of the cells that share them (the field is the same).
///
/// `on_brick(brick_index, length_mm)` is asked at each new brick: to walk its cells (true) or pass
/// it by. `on_cell(passage)` is called for each cell; false ends the walk.
///
/// @pre  the interval comes from `clip_to_grid`
template <class OnBrick, class OnCell>
class GridWalk {
 public:
  GridWalk(const VolumeBricks& bricks, const glm::i64vec3& cells, const CellLine& line,
           OnBrick& on_brick, OnCell& on_cell)
      : bricks_(bricks), cells_(cells), line_(line), on_brick_(on_brick), on_cell_(on_cell) {
    for (int axis = 0; axis < 3; ++axis) {
      const double d = line.direction[axis];
      step_[axis] = d > 0.0 ? 1 : -1;
      inverse_[axis] = 1.0 / d;
    }
  }

  void run(const LineInterval& interval) {
    t_ = interval.t_enter;
    t_end_ = interval.t_exit;
    p_ = position(t_);
    for (int axis = 0; axis < 3; ++axis) {
      cell_[axis] = cell_below(p_[axis], axis, 0, cells_[axis] - 1);
    }
    while (t_ < t_end_) {
      const glm::i64vec3 brick = cell_ >> VolumeBricks::kShift;
      brick_lo_ = brick << VolumeBricks::kShift;
      brick_hi_ = glm::min(brick_lo_ + (VolumeBricks::kSide - 1), cells_ - std::int64_t{1});
      const int axis = exit_axis(brick_lo_, brick_hi_ + std::int64_t{1});
      const double t_out = exit_t(axis, brick_lo_, brick_hi_ + std::int64_t{1});
      if (on_brick_(bricks_.index(brick), std::max(t_out - t_, 0.0))) {
        if (!walk_brick()) return;
      } else {
        leave_brick(axis, t_out);
      }
      if (outside_grid()) return;
    }
  }

 private:
  glm::dvec3 position(double t) const { return line_.origin + t * line_.direction; }

  /// The cell that holds a coordinate; on a plane, the one that the line goes into.
  std::int64_t cell_below(double p, int axis, std::int64_t lo, std::int64_t hi) const {
    double index = std::floor(p);
    if (index == p && line_.direction[axis] < 0.0) index -= 1.0;
    return std::clamp(static_cast<std::int64_t>(index), lo, hi);
  }

  /// Where the line passes the plane through which it leaves [lo, hi] along an axis.
  double plane_t(int axis, const glm::i64vec3& lo, const glm::i64vec3& hi) const {
    if (line_.direction[axis] == 0.0) return std::numeric_limits<double>::infinity();
    const auto plane = static_cast<double>(step_[axis] > 0 ? hi[axis] : lo[axis]);
    return (plane - line_.origin[axis]) * inverse_[axis];
  }

  int exit_axis(const glm::i64vec3& lo, const glm::i64vec3& hi) const {
    const std::array<double, 3> t{plane_t(0, lo, hi), plane_t(1, lo, hi), plane_t(2, lo, hi)};
    return static_cast<int>(std::min_element(t.begin(), t.end()) - t.begin());
  }

  double exit_t(int axis, const glm::i64vec3& lo, const glm::i64vec3& hi) const {
    return std::min(plane_t(axis, lo, hi), t_end_);
  }

  bool outside_grid() const {
    for (int axis = 0; axis < 3; ++axis) {
      if (cell_[axis] < 0 || cell_[axis] >= cells_[axis]) return true;
    }
    return false;
  }

  /// Moves to where the line leaves the current brick, without looking at its cells.
  void leave_brick(int axis, double t_out) {
    t_ = std::max(t_, t_out);
    p_ = position(t_);
    for (int other = 0; other < 3; ++other) {
      cell_[other] = cell_below(p_[other], other, brick_lo_[other], brick_hi_[other]);
    }
    cell_[axis] = step_[axis] > 0 ? brick_hi_[axis] + 1 : brick_lo_[axis] - 1;
  }

  /// False when `on_cell` has seen enough.
  bool walk_brick() {
    glm::dvec3 t_plane;
    for (int axis = 0; axis < 3; ++axis)
      t_plane[axis] = plane_t(axis, cell_, cell_ + std::int64_t{1});
    while (true) {
      int axis = t_plane.x <= t_plane.y ? 0 : 1;
      if (t_plane.z < t_plane[axis]) axis = 2;
      const double t_out = std::min(t_plane[axis], t_end_);
      if (t_out > t_) {
        const glm::dvec3 p_out = position(t_out);
        if (!on_cell_(passage(p_out, t_out))) return false;
        t_ = t_out;
        p_ = p_out;
      }
      if (t_out >= t_end_) {
        t_ = t_end_;
        return true;
      }
      cell_[axis] += step_[axis];
      if (cell_[axis] < brick_lo_[axis] || cell_[axis] > brick_hi_[axis]) return true;
      t_plane[axis] = plane_t(axis, cell_, cell_ + std::int64_t{1});
    }
  }

  CellPassage passage(const glm::dvec3& p_out, double t_out) const {
    const glm::dvec3 corner(cell_);
    return {cell_, glm::clamp(p_ - corner, 0.0, 1.0), glm::clamp(p_out - corner, 0.0, 1.0),
            t_out - t_};
  }

  const VolumeBricks& bricks_;
  const glm::i64vec3 cells_;
  const CellLine& line_;
  OnBrick& on_brick_;
  OnCell& on_cell_;

  glm::i64vec3 step_{1};
  glm::dvec3 inverse_{0.0};

  double t_ = 0.0;
  double t_end_ = 0.0;
  glm::dvec3 p_{0.0};  ///< position(t_)
  glm::i64vec3 cell_{0};
  glm::i64vec3 brick_lo_{0};  ///< first cell of the current brick
  glm::i64vec3 brick_hi_{0};  ///< and its last
};

}  // namespace nacre
