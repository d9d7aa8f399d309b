#pragma once

#include <algorithm>
#include <cmath>
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

/// A line that is no steeper than this along an axis runs along the planes across it.
/// @param steepness  of the line along each axis
inline double slope_along_planes(const glm::dvec3& steepness) {
  return 1e-10 * std::max({steepness.x, steepness.y, steepness.z});
}

/// The part of the interval that lies inside the grid [0, cells], borders included.
///
/// A line in a border plane counts as inside, so that a ray that grazes the volume sees its face.
/// Lines that run along a border plane to rounding (within a hair over their whole way) are put
/// into it; any other line is clipped exactly.
inline std::optional<LineInterval> clip_to_grid(CellLine& line, const glm::i64vec3& cells,
                                                LineInterval interval) {
  constexpr double kHair = 1e-11;  // cells: the rounding of positions some 1e4 cells away
  const glm::dvec3 steepness = glm::abs(line.direction);
  const double along = slope_along_planes(steepness);
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

/// Steps through the boxes of a grid of cubes (cells, or bricks of cells) in the order a line
/// passes them.
///
/// Planes are found from integer indices, never by adding steps, so that no error builds up, and a
/// brick and its cells agree on where their common planes are crossed, to the last bit.
class LineStepper {
 public:
  /// @param side   cells along a cube's edge
  /// @param first  the cube to start in
  LineStepper(const CellLine& line, int side, const glm::ivec3& first)
      : origin_(line.origin), index_(first), side_(side) {
    for (int axis = 0; axis < 3; ++axis) {
      const double d = line.direction[axis];
      step_[axis] = d < 0.0 ? -1 : 1;
      inverse_[axis] = 1.0 / d;
      // Never crossed: (plane - origin) * inverse would be 0 * infinity.
      t_exit_[axis] = d == 0.0 ? std::numeric_limits<double>::infinity() : plane_t(axis);
    }
  }

  const glm::ivec3& index() const { return index_; }

  /// The axis along which the line leaves the current cube.
  int exit_axis() const {
    const int axis = t_exit_[0] <= t_exit_[1] ? 0 : 1;
    return t_exit_[2] < t_exit_[axis] ? 2 : axis;
  }

  /// Where it does so, mm.
  double exit_t(int axis) const { return t_exit_[axis]; }

  void advance(int axis) {
    index_[axis] += step_[axis];
    t_exit_[axis] = plane_t(axis);
  }

 private:
  double plane_t(int axis) const {
    const int plane = side_ * (index_[axis] + (step_[axis] > 0 ? 1 : 0));
    return (plane - origin_[axis]) * inverse_[axis];
  }

  glm::dvec3 origin_;
  glm::dvec3 inverse_{0.0};
  glm::dvec3 t_exit_{0.0};
  glm::ivec3 index_;
  glm::ivec3 step_{1};
  int side_;
};

/// The cube of the given side, within [lo, hi], that holds a point; on a plane, the one that the
/// line goes into.
inline glm::ivec3 cube_at(const CellLine& line, double t, int side, const glm::ivec3& lo,
                          const glm::ivec3& hi) {
  glm::ivec3 cube;
  for (int axis = 0; axis < 3; ++axis) {
    const double p = (line.origin[axis] + t * line.direction[axis]) / side;
    double index = std::floor(p);
    if (index == p && line.direction[axis] < 0.0) index -= 1.0;
    cube[axis] = static_cast<int>(std::clamp<double>(index, lo[axis], hi[axis]));
  }
  return cube;
}

/// A point of the line relative to a cell's lower corner, in [0, 1]^3.
inline glm::dvec3 point_in_cell(const CellLine& line, const glm::ivec3& cell, double t) {
  return glm::clamp(line.origin + t * line.direction - glm::dvec3(cell), 0.0, 1.0);
}

/// What to do with a brick that the line comes to.
enum class BrickVisit {
  Cells,  ///< walk its cells
  Pass,   ///< pass it by
  End,    ///< end the walk before it
};

/// Walks the cells of a grid along a line, from near to far, a brick at a time.
///
/// Each part of the line belongs to exactly one cell: none is lost between cells, none counted
/// twice. Lines along faces and edges take one of the cells that share them (the field is the
/// same).
///
/// @param interval  from `clip_to_grid`
/// @param on_brick  `BrickVisit(brick_index, t_enter, t_exit)`
/// @param on_cell   `bool(cell, t_enter, t_exit)`: false ends the walk
template <class OnBrick, class OnCell>
void walk_grid(const VolumeBricks& bricks, const glm::i64vec3& cells, const CellLine& line,
               const LineInterval& interval, OnBrick&& on_brick, OnCell&& on_cell) {
  constexpr int kSide = VolumeBricks::kSide;
  const glm::ivec3 last_cell = glm::ivec3(cells) - 1;
  const glm::ivec3 last_brick = glm::ivec3(bricks.count) - 1;
  const auto inside = [](const glm::ivec3& index, const glm::ivec3& lo, const glm::ivec3& hi,
                         int axis) { return index[axis] >= lo[axis] && index[axis] <= hi[axis]; };

  LineStepper brick(line, kSide, cube_at(line, interval.t_enter, kSide, glm::ivec3(0), last_brick));
  double t = interval.t_enter;
  while (t < interval.t_exit) {
    const int brick_axis = brick.exit_axis();
    const double t_brick = std::clamp(brick.exit_t(brick_axis), t, interval.t_exit);
    const BrickVisit visit =
        t_brick > t ? on_brick(bricks.index(brick.index()), t, t_brick) : BrickVisit::Pass;
    if (visit == BrickVisit::End) return;
    if (visit == BrickVisit::Cells) {
      const glm::ivec3 lo = kSide * brick.index();
      const glm::ivec3 hi = glm::min(lo + (kSide - 1), last_cell);
      LineStepper cell(line, 1, cube_at(line, t, 1, lo, hi));
      while (t < t_brick) {
        const int axis = cell.exit_axis();
        const double t_cell = std::clamp(cell.exit_t(axis), t, t_brick);
        if (t_cell > t && !on_cell(cell.index(), t, t_cell)) return;
        t = t_cell;
        cell.advance(axis);
        if (!inside(cell.index(), lo, hi, axis)) break;
      }
    }
    t = t_brick;
    brick.advance(brick_axis);
    if (!inside(brick.index(), glm::ivec3(0), last_brick, brick_axis)) return;
  }
}

}  // namespace nacre
