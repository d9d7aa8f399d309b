#include "reference/layer_emission.h"

#include <algorithm>
#include <limits>

#include "reference/cell_reader.h"
#include "reference/cued_emission.h"

namespace nacre {
namespace {

/// The cubic's parts in their order, `on_part(s0, s1, layer)`; some may be of no length.
template <class OnPart>
void for_each_layer(const LayerLadder& ladder, const BernsteinCubic& f, std::size_t at_start,
                    OnPart&& on_part) {
  double s0 = 0.0;
  const auto level = [&](std::size_t index) { return ladder.values[index]; };
  const std::size_t at_end = follow_crossings(f, ladder.values.size(), level, at_start,
                                              [&](std::size_t index, double s, bool rising) {
                                                on_part(s0, s, rising ? index : index + 1);
                                                s0 = s;
                                                return true;
                                              });
  on_part(s0, 1.0, at_end);
}

/// max { beta r } over the cells of a line along which beta falls.
template <class T>
class LayerMaximum {
 public:
  LayerMaximum(const WalkField& field, const LayerLadder& ladder, const CellReader<T>& reader,
               const CellLine& line, const LineCue& beta)
      : field_(field), ladder_(ladder), reader_(reader), line_(line), beta_(beta) {}

  double over(const LineInterval& interval) {
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
    beta_of_brick_ = beta_(t_enter);
    if (ladder_.brightest.back() * beta_of_brick_ <= best_) return BrickVisit::End;
    greatest_layer_ = ladder_.greatest_layer[brick];
    if (ladder_.brightest[greatest_layer_] * beta_of_brick_ <= best_) return BrickVisit::Pass;
    raise_threshold();
    return BrickVisit::Cells;
  }

  /// To the first level of the brick that could win; to the brick's end where none can.
  void raise_threshold() {
    const auto begin = ladder_.brightest.begin() + 1;
    const auto wins = std::partition_point(begin, begin + greatest_layer_, [&](double brightest) {
      return brightest * beta_of_brick_ <= best_;
    });
    first_winning_ = static_cast<std::size_t>(wins - begin);
    threshold_ = first_winning_ == greatest_layer_ ? std::numeric_limits<double>::infinity()
                                                   : ladder_.values[first_winning_];
  }

  void on_cell(const glm::ivec3& cell, double t_enter, double t_exit) {
    const T* base = reader_.first_corner(cell);
    if (reader_.greatest_corner(base) < threshold_) return;
    const BernsteinCubic f = reader_.cubic_in(cell, base, line_, t_enter, t_exit);
    const double before = best_;
    beta_.rise_per_mm == 0.0 ? show(layer_of(maximum(f)), beta_of_brick_)
                             : show_crossings(f, {beta_(t_enter), beta_(t_exit)});
    if (best_ > before) raise_threshold();
  }

  void show(std::size_t layer, double beta) {
    best_ = std::max(best_, ladder_.brightest[layer] * beta);
  }

  /// A shell is brightest where beta is: where it is first entered. Those that cannot win are left
  /// out.
  void show_crossings(const BernsteinCubic& f, const UnitCue& beta) {
    const std::size_t first = first_winning_;
    const std::size_t at_start = layer_of(f.b[0]);
    show(at_start, beta.at_0);
    follow_crossings(
        f, greatest_layer_ - first, [&](std::size_t i) { return ladder_.values[first + i]; },
        at_start - first,
        [&](std::size_t i, double s, bool rising) {
          if (rising) show(first + i + 1, beta(s));
          return true;
        });
  }

  /// The layer, among those of the brick from below the first that can win.
  std::size_t layer_of(double value) const {
    return ladder_.reached(value, first_winning_, greatest_layer_);
  }

  const WalkField& field_;
  const LayerLadder& ladder_;
  const CellReader<T>& reader_;
  const CellLine& line_;
  const LineCue& beta_;
  double best_ = 0.0;
  double beta_of_brick_ = 0.0;        ///< the greatest in the brick: where the line enters it
  std::uint32_t greatest_layer_ = 0;  ///< in the brick
  std::size_t first_winning_ = 0;     ///< index of the lowest level that can win there
  double threshold_ = 0.0;            ///< a cell with no corner of this value cannot win
};

}  // namespace

double max_layer_emission(const WalkField& field, const LayerLadder& ladder, const CellLine& line,
                          const LineInterval& interval, const LineCue& beta) {
  if (beta.rise_per_mm > 0.0) {
    return max_layer_emission(field, ladder, reversed(line, interval.t_exit), interval,
                              reversed(beta, interval.t_exit));
  }
  return with_cells(field, [&]<class T>(const CellReader<T>& reader) {
    return LayerMaximum<T>(field, ladder, reader, line, beta).over(interval);
  });
}

double layer_emission_integral(const WalkField& field, const LayerLadder& ladder,
                               const CellLine& line, const LineInterval& interval,
                               const LineCue& beta) {
  return with_cells(field, [&]<class T>(const CellReader<T>& reader) {
    double sum = 0.0;
    std::size_t lo = 0;  // layers of the brick
    std::size_t hi = 0;
    const auto add = [&](std::size_t layer, double length, double beta_0, double beta_1) {
      sum += ladder.shown[layer] * length * (0.5 * (beta_0 + beta_1));
    };
    const auto on_brick = [&](std::size_t brick, double t_enter, double t_exit) {
      lo = ladder.least_layer[brick];
      hi = ladder.greatest_layer[brick];
      if (lo < hi) return BrickVisit::Cells;
      add(lo, t_exit - t_enter, beta(t_enter), beta(t_exit));
      return BrickVisit::Pass;
    };
    const auto on_cell = [&](const glm::ivec3& cell, double t_enter, double t_exit) {
      const T* base = reader.first_corner(cell);
      const auto [least, greatest] = reader.corner_range(base);
      const UnitCue cue{beta(t_enter), beta(t_exit)};
      const std::size_t layer = ladder.reached(least, lo, hi);
      if (layer == hi || greatest < ladder.values[layer]) {
        add(layer, t_exit - t_enter, cue.at_0, cue.at_1);
        return true;
      }
      const BernsteinCubic f = reader.cubic_in(cell, base, line, t_enter, t_exit);
      for_each_layer(ladder, f, ladder.reached(f.b[0], lo, hi),
                     [&](double s0, double s1, std::size_t n) {
                       add(n, (s1 - s0) * (t_exit - t_enter), cue(s0), cue(s1));
                     });
      return true;
    };
    walk_grid(field.bricks, field.cells, line, interval, on_brick, on_cell);
    return sum;
  });
}

}  // namespace nacre
