#include "shells/budget.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "shells/quantization.h"

namespace nacre {
namespace {

/// A candidate for any volume: the tolerance is that at a shell's mean slope, the grid's step a
/// part of the smallest spacing.
struct Rung {
  std::size_t levels;
  double tolerance;
  double step_spacings;
};

// A little more than a quarter and so on: exact steps just miss those (docs/decisions/005).
constexpr double kCoarseStep = 0.26;
constexpr double kMiddleStep = 0.13;
constexpr double kFineStep = 0.065;
constexpr double kFinestStep = 1.0 / 64.0;

// The tolerance is a little less than a layer's width, which costs least at equal error of maxima
// estimated between the levels (docs/decisions/022-budgets.md). Each set is some 1.1 to 2 times as
// large as the one before it.
constexpr std::array kRungs{
    Rung{1, 0.4, kCoarseStep},    Rung{2, 0.28, kCoarseStep},   Rung{3, 0.23, kCoarseStep},
    Rung{4, 0.2, kCoarseStep},    Rung{5, 0.165, kCoarseStep},  Rung{6, 0.155, kCoarseStep},
    Rung{7, 0.13, kCoarseStep},   Rung{8, 0.115, kCoarseStep},  Rung{9, 0.1, kCoarseStep},
    Rung{10, 0.09, kCoarseStep},  Rung{10, 0.09, kMiddleStep},  Rung{11, 0.084, kMiddleStep},
    Rung{12, 0.078, kMiddleStep}, Rung{14, 0.066, kMiddleStep}, Rung{16, 0.058, kMiddleStep},
    Rung{18, 0.052, kMiddleStep}, Rung{20, 0.047, kMiddleStep}, Rung{24, 0.039, kMiddleStep},
    Rung{28, 0.033, kFineStep},   Rung{32, 0.028, kFineStep},   Rung{40, 0.022, kFineStep},
    Rung{48, 0.018, kFinestStep}, Rung{64, 0.013, kFinestStep},
};

constexpr std::array kTolerances{0.4, 0.3, 0.2, 0.15, 0.1, 0.07, 0.05, 0.035, 0.025, 0.018, 0.012};
constexpr std::array<std::size_t, 19> kLevels{1,  2,  3,  4,  5,  6,  7,  8,  10, 12,
                                              14, 16, 20, 24, 28, 32, 40, 48, 64};

/// The grid that suits a tolerance where the rungs do not say it.
double step_for(double tolerance) {
  if (tolerance > 0.07) return kCoarseStep;
  if (tolerance > 0.036) return kMiddleStep;
  return tolerance > 0.019 ? kFineStep : kFinestStep;
}

/// The nearest number of six decimals: one that can be typed again.
double short_decimal(double x) { return std::round(1e6 * x) / 1e6; }

std::vector<Rung> rungs_for(const LadderOptions& options) {
  std::vector<Rung> rungs;
  const double held = options.tolerance.value_or(0.0) / weight_at_mean_slope(options.weight);
  if (options.levels && options.tolerance) {
    for (const double step : {kCoarseStep, kMiddleStep, kFineStep, kFinestStep}) {
      rungs.push_back({*options.levels, held, step});
    }
  } else if (options.levels) {
    for (const double tolerance : kTolerances) {
      rungs.push_back({*options.levels, tolerance, step_for(tolerance)});
    }
  } else if (options.tolerance) {
    for (const std::size_t levels : kLevels) {
      rungs.push_back({levels, held, step_for(held)});
    }
  } else {
    rungs.assign(kRungs.begin(), kRungs.end());
  }
  return rungs;
}

/// The fewest bits of a grid whose step is small enough, or the most there are.
int bits_for(const glm::i64vec3& dims, const glm::dmat4& world_from_voxel, double step_spacings) {
  constexpr int kFewest = 4;
  constexpr int kMost = 23;
  int bits = kFewest;
  while (bits < kMost &&
         choose_grid(dims, world_from_voxel, {.bits = bits}).step_spacings > step_spacings) {
    ++bits;
  }
  return bits;
}

bool is_same(const BudgetCandidate& a, const BudgetCandidate& b) {
  return a.levels == b.levels && a.tolerance == b.tolerance && a.bits == b.bits;
}

}  // namespace

std::vector<BudgetCandidate> budget_ladder(const glm::i64vec3& dims,
                                           const glm::dmat4& world_from_voxel,
                                           const LadderOptions& options) {
  std::vector<BudgetCandidate> ladder;
  for (const Rung& rung : rungs_for(options)) {
    const double step = options.unit == Budget::Unit::Triangles ? kFinestStep : rung.step_spacings;
    const BudgetCandidate candidate{
        rung.levels,
        options.tolerance.value_or(
            short_decimal(std::min(weight_at_mean_slope(options.weight) * rung.tolerance, 1.0))),
        options.bits ? *options.bits : bits_for(dims, world_from_voxel, step), options.placement,
        options.weight};
    if (ladder.empty() || !is_same(ladder.back(), candidate)) ladder.push_back(candidate);
  }
  return ladder;
}

bool fits(const SetSize& size, const Budget& budget) noexcept {
  return (budget.unit == Budget::Unit::Bytes ? size.bytes : size.triangles) <= budget.most;
}

BudgetTrade trade(const Budget& budget, std::span<const BudgetCandidate> ladder,
                  const TrialSteps& steps, BudgetTrade before) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  BudgetTrade trade = std::move(before);
  double least = trade.chosen ? trade.trials[*trade.chosen].rmse.value_or(kNone) : kNone;
  // The search's end must not depend on what other ladders gave: that depends on the budget.
  double least_here = kNone;
  std::size_t without_gain = 0;
  for (const BudgetCandidate& candidate : ladder) {
    BudgetTrial trial{candidate, steps.build(candidate), std::nullopt};
    if (fits(trial.size, budget)) trial.rmse = steps.measure();
    if (steps.tried) steps.tried(trial);
    trade.trials.push_back(trial);
    if (!trial.rmse) break;
    if (*trial.rmse < least) {
      least = *trial.rmse;
      trade.chosen = trade.trials.size() - 1;
      steps.keep();
    }
    without_gain = *trial.rmse < least_here ? 0 : without_gain + 1;
    least_here = std::min(least_here, *trial.rmse);
    if (without_gain == kTrialsWithoutGain) break;
  }
  return trade;
}

}  // namespace nacre
