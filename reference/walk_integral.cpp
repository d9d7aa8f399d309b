#include "reference/walk_integral.h"

#include <algorithm>

#include "reference/cell_reader.h"
#include "reference/mean_emission.h"

namespace nacre {
namespace {

/// Adds up a line's parts: `constant(emission, t_enter, t_exit)` where the map is flat,
/// `part(cubic, t_enter, t_exit)` elsewhere.
template <class OnConstant, class OnPart>
double integrate(const WalkField& field, const CellLine& line, const LineInterval& interval,
                 OnConstant&& constant, OnPart&& part) {
  const EmissionKnot& first = field.emission_of_field.knots().front();
  const EmissionKnot& last = field.emission_of_field.knots().back();
  return with_cells(field, [&]<class T>(const CellReader<T>& reader) {
    double sum = 0.0;
    const auto on_brick = [&](std::size_t brick, double t_enter, double t_exit) {
      const bool dark = field.bricks.greatest[brick] <= first.value;
      if (!dark && field.bricks.least[brick] < last.value) return BrickVisit::Cells;
      sum += constant(dark ? first.emission : last.emission, t_enter, t_exit);
      return BrickVisit::Pass;
    };
    const auto on_cell = [&](const glm::ivec3& cell, double t_enter, double t_exit) {
      const T* base = reader.first_corner(cell);
      sum += reader.greatest_corner(base) <= first.value
                 ? constant(first.emission, t_enter, t_exit)
                 : part(reader.cubic_in(cell, base, line, t_enter, t_exit), t_enter, t_exit);
      return true;
    };
    walk_grid(field.bricks, field.cells, line, interval, on_brick, on_cell);
    return sum;
  });
}

}  // namespace

double emission_integral(const WalkField& field, const CellLine& line,
                         const LineInterval& interval) {
  return integrate(
      field, line, interval,
      [](double emission, double t_enter, double t_exit) { return emission * (t_exit - t_enter); },
      [&](const BernsteinCubic& f, double t_enter, double t_exit) {
        return (t_exit - t_enter) * mean_emission(field.emission_of_field, f);
      });
}

double cued_emission_integral(const WalkField& field, const CuedEmission& emission,
                              const CellLine& line, const LineInterval& interval,
                              const LineCue& beta) {
  const double scale = std::max(beta(interval.t_enter), beta(interval.t_exit));
  if (scale == 0.0) return 0.0;
  const LineCue unit{beta.at_enter / scale, beta.rise_per_mm / scale};
  return scale * integrate(
                     field, line, interval,
                     [&](double phi, double t_enter, double t_exit) {
                       return phi * (t_exit - t_enter) * (0.5 * (unit(t_enter) + unit(t_exit)));
                     },
                     [&](const BernsteinCubic& f, double t_enter, double t_exit) {
                       return (t_exit - t_enter) * emission.mean(f, {unit(t_enter), unit(t_exit)});
                     });
}

}  // namespace nacre
