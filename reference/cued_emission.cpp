#include "reference/cued_emission.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/knot_splits.h"
#include "reference/quartic.h"

namespace nacre {
namespace {

/// How far below a piece, in its heights, its line may be followed: beyond, the digits of what lies
/// within the piece would be lost to what does not.
constexpr double kSteepest = 1e3;

/// The largest value of the product inside (0, 1) where T(f) is a line of f, or `floor`.
double inner_maximum_above(double floor, const BernsteinCubic& f, const UnitCue& beta,
                           const LinearPiece& piece) {
  const double height = piece.top() - piece.bottom();
  if (height == 0.0) return floor;
  // Coefficients of a cubic that keeps to the piece lie within a few heights of it; beyond is
  // rounding in a piece that is hardly wider than an ulp.
  BernsteinCubic g;
  for (std::size_t i = 0; i < 4; ++i) {
    g.b[i] = std::clamp(piece(f.b[i]), piece.bottom() - 4.0 * kSteepest * height,
                        piece.top() + 8.0 * height);
  }
  const BernsteinQuartic c = product(beta.at_0, beta.at_1, g);
  const double ends = std::max({floor, c.b[0], c.b[4]});
  if (c.b[1] <= ends && c.b[2] <= ends && c.b[3] <= ends) return floor;
  double best = floor;
  const UnitRoots critical = critical_points(c);
  for (std::size_t i = 0; i < critical.count; ++i) {
    const double emission = std::clamp(evaluate(g, critical.s[i]), piece.bottom(), piece.top());
    best = std::max(best, beta(critical.s[i]) * emission);
  }
  return best;
}

}  // namespace

LinearPiece::LinearPiece(const EmissionKnot& a, const EmissionKnot& b) noexcept
    : bottom_(a.emission),
      rise_(b.emission - a.emission),
      scale_(std::isfinite(b.value - a.value) ? 1.0 : 0.5),
      start_(a.value * scale_),
      width_(b.value * scale_ - start_),
      end_(b.value) {}

CuedEmission::CuedEmission(EmissionMap map) : map_(std::move(map)) {
  const auto knots = map_.knots();
  for (std::size_t i = 1; i < knots.size(); ++i) pieces_.emplace_back(knots[i - 1], knots[i]);
}

double CuedEmission::maximum_above(double floor, const BernsteinCubic& f,
                                   const UnitCue& beta) const {
  const auto [least, greatest] = std::minmax_element(f.b.begin(), f.b.end());
  const double ends = std::max(beta.at_0 * map_(f.b[0]), beta.at_1 * map_(f.b[3]));
  const double best = std::max(floor, ends);
  if (map_(*greatest) * std::max(beta.at_0, beta.at_1) <= best) return best;

  // Within the first piece and below: T is the greater of a line and a constant, whose product with
  // beta is greatest at an end.
  const LinearPiece& first = pieces_.front();
  if (*greatest <= first.end() &&
      first(*least) >= first.bottom() - kSteepest * (first.top() - first.bottom())) {
    return inner_maximum_above(best, f, beta, first);
  }
  return split_maximum_above(best, f, beta);
}

double CuedEmission::split_maximum_above(double floor, const BernsteinCubic& f,
                                         const UnitCue& beta) const {
  double best = floor;
  const auto knots = map_.knots();
  for_each_piece(map_, f, [&](double s0, double s1, std::size_t knots_below) {
    // At a knot the emission is the knot's: f, rounded there, may miss it in a steep piece.
    const bool within = knots_below > 0 && knots_below < knots.size();
    const double lowest = knots_below > 0 ? knots[knots_below - 1].emission : knots[0].emission;
    best = std::max(best, lowest * std::max(beta(s0), beta(s1)));
    if (within && s0 < s1) {
      best = inner_maximum_above(best, restrict_to(f, s0, s1), {beta(s0), beta(s1)},
                                 pieces_[knots_below - 1]);
    }
  });
  return best;
}

double CuedEmission::mean(const BernsteinCubic& f, const UnitCue& beta) const {
  // In a piece of T, with weights 2 (1-s) and 2 s: mean beta T(f) = (beta0 T(A) + beta1 T(B)) / 2,
  // A and B the weighted means of f, which lie within the piece.
  const auto mean_within = [&](const BernsteinCubic& g, const UnitCue& cue) {
    const auto& b = g.b;
    const double early = 0.1 * ((4.0 * b[0] + 3.0 * b[1]) + (2.0 * b[2] + b[3]));
    const double late = 0.1 * ((b[0] + 2.0 * b[1]) + (3.0 * b[2] + 4.0 * b[3]));
    return 0.5 * (cue.at_0 * map_(early) + cue.at_1 * map_(late));
  };
  const auto [least, greatest] = std::minmax_element(f.b.begin(), f.b.end());
  if (!any_knot_between(map_, *least, *greatest)) return mean_within(f, beta);

  double sum = 0.0;
  for_each_piece(map_, f, [&](double s0, double s1, std::size_t) {
    if (s0 < s1) {
      sum += (s1 - s0) * mean_within(restrict_to(f, s0, s1), {beta(s0), beta(s1)});
    }
  });
  return sum;
}

}  // namespace nacre
