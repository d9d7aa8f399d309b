#include "reference/layer_crossings.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "reference/cell_reader.h"

namespace nacre {
namespace {

using OnCrossing = std::function<bool(const LayerCrossing&)>;

/// Carries the number of levels reached along a line, and tells of each change.
template <class T>
class CrossingWalk {
 public:
  CrossingWalk(const WalkField& field, const LayerLadder& ladder, const CellReader<T>& reader,
               const BoxPassage& passage, const OnCrossing& on_crossing)
      : field_(field),
        ladder_(ladder),
        reader_(reader),
        passage_(passage),
        on_crossing_(on_crossing) {}

  void run() {
    const CellLine& line = passage_.line;
    const LineInterval& interval = passage_.interval;
    reached_ = passage_.entry_axis ? 0 : reached_at_start();
    walk_grid(
        field_.bricks, field_.cells, line, interval,
        [&](std::size_t brick, double t_enter, double) { return on_brick(brick, t_enter); },
        [&](const glm::ivec3& cell, double t_enter, double t_exit) {
          on_cell(cell, t_enter, t_exit);
          return !ended_;
        });
    if (!ended_ && passage_.exit_axis) {
      change_to(0, interval.t_exit, cell_of(interval.t_exit), passage_.exit_axis);
    }
  }

 private:
  glm::ivec3 cell_of(double t) const {
    return cube_at(passage_.line, t, 1, glm::ivec3(0), glm::ivec3(field_.cells) - 1);
  }

  std::size_t reached_at_start() const {
    const glm::ivec3 cell = cell_of(0.0);
    return ladder_.reached(trilinear(reader_.corners(reader_.first_corner(cell)),
                                     point_in_cell(passage_.line, cell, 0.0)));
  }

  bool tell(std::size_t level, double t, bool entering, const glm::ivec3& cell,
            std::optional<int> face) {
    if (!ended_) ended_ = !on_crossing_({level, t, entering, cell, face});
    return !ended_;
  }

  /// All changes in one place.
  void change_to(std::size_t reached, double t, const glm::ivec3& cell, std::optional<int> face) {
    for (; reached_ < reached && tell(reached_, t, true, cell, face); ++reached_) {
    }
    for (; reached_ > reached && tell(reached_ - 1, t, false, cell, face); --reached_) {
    }
  }

  /// What is reached on arrival in the border plane is reached through a cap.
  std::optional<int> face_at(double t) const {
    return t == passage_.interval.t_enter ? passage_.entry_axis : std::nullopt;
  }

  BrickVisit on_brick(std::size_t brick, double t_enter) {
    const std::size_t layer = ladder_.least_layer[brick];
    if (layer != ladder_.greatest_layer[brick]) return BrickVisit::Cells;
    if (layer != reached_) change_to(layer, t_enter, cell_of(t_enter), face_at(t_enter));
    return ended_ ? BrickVisit::End : BrickVisit::Pass;
  }

  void on_cell(const glm::ivec3& cell, double t_enter, double t_exit) {
    const T* base = reader_.first_corner(cell);
    const auto [least, greatest] = reader_.corner_range(base);
    const auto& values = ladder_.values;
    const bool rises = reached_ < values.size() && greatest >= values[reached_];
    const bool falls = reached_ > 0 && least < values[reached_ - 1];
    if (!rises && !falls) return;
    reached_ = follow_crossings(
        reader_.cubic_in(cell, base, passage_.line, t_enter, t_exit), values.size(),
        [&](std::size_t level) { return values[level]; }, reached_,
        [&](std::size_t level, double s, bool rising) {
          const double t = t_enter + s * (t_exit - t_enter);
          return tell(level, t, rising, cell, s == 0.0 ? face_at(t_enter) : std::nullopt);
        });
  }

  const WalkField& field_;
  const LayerLadder& ladder_;
  const CellReader<T>& reader_;
  const BoxPassage& passage_;
  const OnCrossing& on_crossing_;
  std::size_t reached_ = 0;
  bool ended_ = false;
};

/// The trilinear interpolant's gradient at p in [0, 1]^3.
glm::dvec3 gradient(const CellCorners& c, const glm::dvec3& p) {
  const auto mix = [](double a, double b, double s) { return a + (b - a) * s; };
  const auto plane = [&](double a, double b, double d, double e, double s, double t) {
    return mix(mix(a, b, s), mix(d, e, s), t);
  };
  return {plane(c[1] - c[0], c[3] - c[2], c[5] - c[4], c[7] - c[6], p.y, p.z),
          plane(c[2] - c[0], c[3] - c[1], c[6] - c[4], c[7] - c[5], p.x, p.z),
          plane(c[4] - c[0], c[5] - c[1], c[6] - c[2], c[7] - c[3], p.x, p.y)};
}

/// Of unit length whatever the magnitude; 0 for 0.
glm::dvec3 safely_normalized(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  // Twice: a quotient by a denormal may be coarse, but is of order one.
  return largest > 0.0 ? glm::normalize(v / largest) : glm::dvec3(0.0);
}

}  // namespace

void for_each_crossing(const WalkField& field, const LayerLadder& ladder, const BoxPassage& passage,
                       const std::function<bool(const LayerCrossing&)>& on_crossing) {
  with_cells(field, [&]<class T>(const CellReader<T>& reader) {
    CrossingWalk<T>(field, ladder, reader, passage, on_crossing).run();
  });
}

glm::dvec3 outward_normal(const WalkField& field, const CellLine& line,
                          const LayerCrossing& crossing) {
  glm::dvec3 outward_cell(0.0);
  if (crossing.face_axis) {
    const int axis = *crossing.face_axis;
    const double sign = crossing.entering ? -1.0 : 1.0;
    outward_cell[axis] = std::copysign(1.0, sign * line.direction[axis]);
  } else {
    outward_cell = with_cells(field, [&]<class T>(const CellReader<T>& reader) {
      const CellCorners corners = reader.corners(reader.first_corner(crossing.cell));
      return -gradient(corners, point_in_cell(line, crossing.cell, crossing.t));
    });
  }
  // A gradient is a covector: the inverse transpose of the frame takes it to the world.
  return safely_normalized(glm::transpose(field.frame.cell_from_world) *
                           safely_normalized(outward_cell));
}

}  // namespace nacre
