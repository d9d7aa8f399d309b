#pragma once

#include <cstddef>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/tolerance_weight.h"

namespace nacre {

/// What a shell set may take at most.
struct Budget {
  enum class Unit { Bytes, Triangles };
  Unit unit = Unit::Bytes;
  std::size_t most = 0;
};

/// One way to build a set: the more levels, the smaller the tolerance and the finer the grid, the
/// larger the set, and the better its pictures until contouring is what errs.
struct BudgetCandidate {
  std::size_t levels = 1;
  double tolerance = 0.0;             ///< emission, see `BuildOptions::emission_tolerance`
  int bits = 12;                      ///< of a coordinate on the set's grid
  std::string placement = "uniform";  ///< of the levels, see `ShellSet`
  ToleranceWeight weight = ToleranceWeight::Picture;
};

/// What a caller has chosen already, in place of what the ladder would try.
struct LadderOptions {
  std::optional<std::size_t> levels = {};
  std::optional<double> tolerance = {};
  std::optional<int> bits = {};
  std::string placement = "uniform";                  ///< of every candidate
  ToleranceWeight weight = ToleranceWeight::Picture;  ///< likewise
  Budget::Unit unit = Budget::Unit::Bytes;  ///< triangles cost the same on any grid: the finest
};

/// The candidates for a volume, small sets first: each with the tolerance and the grid that were
/// measured to suit its number of levels (docs/decisions/022-budgets.md). One or more.
///
/// It depends on neither the budget nor the samples.
/// @throws Error  as `choose_grid`
std::vector<BudgetCandidate> budget_ladder(const glm::i64vec3& dims,
                                           const glm::dmat4& world_from_voxel,
                                           const LadderOptions& options = {});

/// How large a set is.
struct SetSize {
  std::size_t bytes = 0;  ///< of its file
  std::size_t triangles = 0;
};

/// A candidate that was built.
struct BudgetTrial {
  BudgetCandidate candidate;
  SetSize size;
  std::optional<double> rmse;  ///< of maximum projections, emission; none where it does not fit
};

/// How a candidate is tried. The calls come one after the other, for one candidate after the other.
struct TrialSteps {
  /// Builds a set.
  std::function<SetSize(const BudgetCandidate&)> build;
  /// The root mean square error of the maximum projections of the set built last.
  std::function<double()> measure;
  /// Keeps the set built last: it is the best so far.
  std::function<void()> keep;
  /// Called with each trial when it is done; may be none.
  std::function<void(const BudgetTrial&)> tried = {};
};

/// What was tried, and which is the best that fits.
struct BudgetTrade {
  std::vector<BudgetTrial> trials;    ///< in the order they were tried
  std::optional<std::size_t> chosen;  ///< a trial; none where not even the first fits
};

bool fits(const SetSize& size, const Budget& budget) noexcept;

/// Tries the candidates in order until one does not fit (or `kTrialsWithoutGain` in a row were no
/// better than those before), and chooses the one with the least measured error of those that fit;
/// of equal ones the first.
///
/// A larger budget never gives a worse picture, by construction: where a search ends does depend on
/// the budget, but what is tried before is the same, so that a larger budget chooses among all that
/// a smaller one chooses among, and maybe more.
///
/// @param before  what was tried already, on other ladders: its best is the one to beat
BudgetTrade trade(const Budget& budget, std::span<const BudgetCandidate> ladder,
                  const TrialSteps& steps, BudgetTrade before = {});

/// So many candidates in a row without a better picture end the search: contouring is what errs.
inline constexpr std::size_t kTrialsWithoutGain = 3;

}  // namespace nacre
