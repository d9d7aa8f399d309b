#include "reference/walk_maximum.h"

#include <algorithm>

#include "reference/cell_reader.h"

namespace nacre {
namespace {

/// max { beta T } over the cells of a line along which beta falls.
template <class T>
class CuedMaximum {
 public:
  CuedMaximum(const WalkField& field, const CuedEmission& emission, const CellReader<T>& reader,
              const CellLine& line, const LineCue& beta)
      : field_(field), emission_(emission), reader_(reader), line_(line), beta_(beta) {}

  double over(const LineInterval& interval) {
    best_ = field_.emission_of_field.knots().front().emission * beta_(interval.t_enter);
    walk_grid(
        field_.bricks, field_.cells, line_, interval,
        [&](std::size_t brick, double t_enter, double) { return on_brick(brick, t_enter); },
        [&](const glm::ivec3& cell, double t_enter, double t_exit) {
          on_cell(cell, t_enter, t_exit);
          return true;
        });
    return best_;
  }

 private:
  BrickVisit on_brick(std::size_t brick, double t_enter) {
    const double beta = beta_(t_enter);
    if (field_.brightest_of_all * beta <= best_) return BrickVisit::End;
    if (field_.brightest[brick] * beta <= best_) return BrickVisit::Pass;
    beta_of_brick_ = beta;
    threshold_ = least_field_above(field_.emission_of_field, best_ / beta);
    return BrickVisit::Cells;
  }

  void on_cell(const glm::ivec3& cell, double t_enter, double t_exit) {
    const T* base = reader_.first_corner(cell);
    if (!(reader_.greatest_corner(base) > threshold_)) return;
    const UnitCue cue{beta_(t_enter), beta_(t_exit)};
    const double seen =
        emission_.maximum_above(best_, reader_.cubic_in(cell, base, line_, t_enter, t_exit), cue);
    if (!(seen > best_)) return;
    best_ = seen;
    threshold_ = least_field_above(field_.emission_of_field, best_ / beta_of_brick_);
  }

  const WalkField& field_;
  const CuedEmission& emission_;
  const CellReader<T>& reader_;
  const CellLine& line_;
  const LineCue& beta_;
  double best_ = 0.0;
  double beta_of_brick_ = 0.0;  ///< the greatest in the brick: where the line enters it
  double threshold_ = 0.0;      ///< a cell with no greater corner cannot win
};

}  // namespace

double max_field(const WalkField& field, const CellLine& line, const LineInterval& interval,
                 double floor, double ceiling) {
  return with_cells(field, [&]<class T>(const CellReader<T>& reader) {
    double best = floor;
    const auto on_brick = [&](std::size_t brick, double, double) {
      return field.bricks.greatest[brick] > best ? BrickVisit::Cells : BrickVisit::Pass;
    };
    const auto on_cell = [&](const glm::ivec3& cell, double t_enter, double t_exit) {
      const T* base = reader.first_corner(cell);
      if (reader.greatest_corner(base) > best) {
        best = std::max(best, maximum(reader.cubic_in(cell, base, line, t_enter, t_exit)));
      }
      return best < ceiling;
    };
    walk_grid(field.bricks, field.cells, line, interval, on_brick, on_cell);
    return best;
  });
}

double max_cued_emission(const WalkField& field, const CuedEmission& emission, const CellLine& line,
                         const LineInterval& interval, const LineCue& beta) {
  if (beta.rise_per_mm > 0.0)
    return max_cued_emission(field, emission, reversed(line, interval.t_exit), interval,
                             reversed(beta, interval.t_exit));
  const double scale = beta(interval.t_enter);
  if (scale == 0.0) return 0.0;
  const LineCue unit{beta.at_enter / scale, beta.rise_per_mm / scale};
  return scale * with_cells(field, [&]<class T>(const CellReader<T>& reader) {
           return CuedMaximum<T>(field, emission, reader, line, unit).over(interval);
         });
}

}  // namespace nacre
