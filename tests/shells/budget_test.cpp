#include "shells/budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "core/volume_geometry.h"
#include "shells/quantization.h"

namespace nacre {
namespace {

constexpr glm::i64vec3 kDims{256, 256, 120};
const glm::dmat4 kSpacing = glm::scale(glm::dmat4(1.0), glm::dvec3(0.7, 0.7, 1.2));

std::vector<BudgetCandidate> ladder_of(const LadderOptions& options = {}) {
  return budget_ladder(kDims, kSpacing, options);
}

/// Sets that are not built: their sizes and errors are listed.
struct Listed {
  std::vector<SetSize> sizes;
  std::vector<double> errors;

  BudgetTrade within(const Budget& budget, const BudgetTrade& before = {}) {
    std::size_t built = 0;
    kept.reset();
    TrialSteps steps;
    steps.build = [&](const BudgetCandidate&) { return sizes[built++]; };
    steps.measure = [&] { return errors[built - 1]; };
    steps.keep = [&] { kept = built - 1; };
    const std::vector<BudgetCandidate> ladder(sizes.size());
    return trade(budget, ladder, steps, before);
  }

  std::optional<std::size_t> kept = {};
};

/// Sizes and errors in any order: nothing that a real ladder gives is worse.
Listed random_sets(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::size_t> size(1, 1000);
  std::uniform_real_distribution<double> error(0.0, 1.0);
  Listed sets;
  for (int i = 0; i < 20; ++i) {
    sets.sizes.push_back({size(random), size(random)});
    sets.errors.push_back(error(random));
  }
  return sets;
}

TEST(Budget, ALargerOneNeverGivesAWorsePictureWhateverTheSetsAre) {
  for (const Budget::Unit unit : {Budget::Unit::Bytes, Budget::Unit::Triangles}) {
    for (unsigned seed = 0; seed < 50; ++seed) {
      Listed sets = random_sets(seed);
      double before = 2.0;
      for (std::size_t most = 0; most <= 1000; most += 10) {
        const BudgetTrade traded = sets.within({unit, most});
        if (!traded.chosen) {
          EXPECT_EQ(before, 2.0) << "seed " << seed << ", a smaller budget held a set";
          continue;
        }
        const BudgetTrial& chosen = traded.trials[*traded.chosen];
        EXPECT_LE(*chosen.rmse, before) << "seed " << seed << ", " << most;
        before = *chosen.rmse;
      }
    }
  }
}

TEST(Budget, TheChosenSetFitsAndIsTheOneKept) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    Listed sets = random_sets(seed);
    for (std::size_t most = 0; most <= 1000; most += 50) {
      const Budget budget{Budget::Unit::Bytes, most};
      const BudgetTrade traded = sets.within(budget);
      EXPECT_EQ(traded.chosen, sets.kept);
      if (!traded.chosen) continue;
      EXPECT_TRUE(fits(traded.trials[*traded.chosen].size, budget));
      for (const BudgetTrial& trial : traded.trials) {
        EXPECT_LE(*traded.trials[*traded.chosen].rmse, trial.rmse.value_or(1.0));
      }
    }
  }
}

TEST(Budget, NothingIsChosenWhereTheFirstSetIsTooLarge) {
  Listed sets{{{100, 10}, {50, 5}}, {0.1, 0.2}};
  const BudgetTrade traded = sets.within({Budget::Unit::Bytes, 99});
  EXPECT_FALSE(traded.chosen);
  ASSERT_EQ(traded.trials.size(), 1u);
  EXPECT_FALSE(traded.trials[0].rmse);
}

TEST(Budget, ALargerOneNeverGivesAWorsePictureOnSeveralLadders) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    Listed first = random_sets(seed);
    Listed second = random_sets(seed + 100);
    double before = 2.0;
    for (std::size_t most = 0; most <= 1000; most += 10) {
      const Budget budget{Budget::Unit::Bytes, most};
      const BudgetTrade traded = second.within(budget, first.within(budget));
      if (!traded.chosen) continue;
      const BudgetTrial& chosen = traded.trials[*traded.chosen];
      EXPECT_TRUE(fits(chosen.size, budget));
      EXPECT_LE(*chosen.rmse, before) << "seed " << seed << ", " << most;
      before = *chosen.rmse;
    }
  }
}

TEST(Budget, TheSearchEndsWhereNothingIsGained) {
  Listed sets{std::vector<SetSize>(10, SetSize{1, 1}), std::vector<double>(10, 0.5)};
  const BudgetTrade traded = sets.within({Budget::Unit::Bytes, 1});
  EXPECT_EQ(traded.chosen, 0u);
  EXPECT_EQ(traded.trials.size(), 1 + kTrialsWithoutGain);
}

TEST(Budget, TheLadderHoldsWhatIsGiven) {
  for (const BudgetCandidate& candidate : ladder_of({.levels = 7})) {
    EXPECT_EQ(candidate.levels, 7u);
  }
  for (const BudgetCandidate& candidate : ladder_of({.tolerance = 0.03})) {
    EXPECT_EQ(candidate.tolerance, 0.03);
  }
  for (const BudgetCandidate& candidate : ladder_of({.bits = 13})) EXPECT_EQ(candidate.bits, 13);
  EXPECT_EQ(ladder_of({.levels = 7, .tolerance = 0.03, .bits = 13}).size(), 1u);
}

// A held tolerance stays what it is; its grid is the one that suits what it leaves at the mean
// slope.
TEST(Budget, TheLadderWeighsTolerancesForPicturesUnlessAsked) {
  const std::vector<BudgetCandidate> picture = ladder_of();
  const std::vector<BudgetCandidate> even = ladder_of({.weight = ToleranceWeight::Field});
  ASSERT_EQ(picture.size(), even.size());
  for (std::size_t i = 0; i < even.size(); ++i) {
    EXPECT_EQ(picture[i].weight, ToleranceWeight::Picture);
    EXPECT_EQ(even[i].weight, ToleranceWeight::Field);
    EXPECT_DOUBLE_EQ(picture[i].tolerance, std::min(3.0 * even[i].tolerance, 1.0));
    EXPECT_EQ(picture[i].bits, even[i].bits);
  }
  const BudgetCandidate held = ladder_of({.tolerance = 0.24}).front();
  const BudgetCandidate held_even =
      ladder_of({.tolerance = 0.08, .weight = ToleranceWeight::Field}).front();
  EXPECT_EQ(held.tolerance, 0.24);
  EXPECT_EQ(held.bits, held_even.bits);
}

TEST(Budget, TheLadderRisesInLevelsAndFinenessTogether) {
  for (const LadderOptions& options :
       {LadderOptions{}, LadderOptions{.levels = 7}, LadderOptions{.tolerance = 0.03},
        LadderOptions{.levels = 7, .tolerance = 0.03},
        LadderOptions{.unit = Budget::Unit::Triangles}}) {
    const std::vector<BudgetCandidate> ladder = ladder_of(options);
    ASSERT_GT(ladder.size(), 1u);
    for (std::size_t i = 1; i < ladder.size(); ++i) {
      EXPECT_GE(ladder[i].levels, ladder[i - 1].levels);
      EXPECT_LE(ladder[i].tolerance, ladder[i - 1].tolerance);
      EXPECT_GE(ladder[i].bits, ladder[i - 1].bits);
    }
  }
}

TEST(Budget, TheGridFollowsTheVolumeNotANumberOfBits) {
  const auto step_of = [](const glm::i64vec3& dims) {
    const BudgetCandidate coarsest = budget_ladder(dims, kSpacing).front();
    return choose_grid(dims, kSpacing, {.bits = coarsest.bits}).step_spacings;
  };
  EXPECT_LE(step_of({16, 16, 16}), 0.26);
  EXPECT_GT(step_of({16, 16, 16}), 0.1);
  EXPECT_LE(step_of({700, 700, 700}), 0.26);
  EXPECT_GT(step_of({700, 700, 700}), 0.1);
}

}  // namespace
}  // namespace nacre
