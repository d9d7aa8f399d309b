#include "app/budget_building.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/budget_flag.h"
#include "app/set_building.h"
#include "app/set_certificate.h"
#include "core/error.h"
#include "shells/budget.h"
#include "shells/certificate.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

double psnr_db(double rmse) { return -20.0 * std::log10(rmse); }

LadderOptions held_by(const ShellFlags& flags, const EmissionMap& emission, Budget::Unit unit,
                      const std::string& placement) {
  LadderOptions held;
  held.unit = unit;
  held.placement = placement;
  if (!flags.levels.empty() || !flags.level_values.empty()) {
    held.levels = levels_of(flags, emission).size();
  }
  held.tolerance = flags.tolerance;
  const bool is_field = flags.tolerance_weight.empty() ? flags.tolerance.has_value()
                                                       : flags.tolerance_weight == kFieldWeight;
  held.weight = is_field ? ToleranceWeight::Field : ToleranceWeight::Picture;
  if (flags.quantization > 0) held.bits = flags.quantization;
  return held;
}

ShellFlags flags_of(const ShellFlags& flags, const BudgetCandidate& candidate) {
  ShellFlags tried = flags;
  if (flags.levels.empty() && flags.level_values.empty()) {
    tried.levels = std::to_string(candidate.levels);
  }
  tried.placement = candidate.placement;
  tried.tolerance = candidate.tolerance;
  tried.tolerance_weight = name(candidate.weight);
  tried.quantization = candidate.bits;
  return tried;
}

CommonFlags quiet_flags() {
  CommonFlags flags;
  flags.quiet = true;
  return flags;
}

std::string words(const BudgetCandidate& candidate) {
  return fmt::format(
      "--levels {} --placement {} --tolerance {} --tolerance-weight {} --quantization {}",
      candidate.levels, candidate.placement, candidate.tolerance, name(candidate.weight),
      candidate.bits);
}

/// Builds the candidates of one volume, one after the other, and keeps the best.
class Trials {
 public:
  Trials(const BudgetFlags& budget, const ShellFlags& flags, const EmissionVolume& input,
         const std::filesystem::path& scratch_folder, Reporter& reporter)
      : flags_(flags),
        input_(input),
        scratch_folder_(scratch_folder),
        reporter_(reporter),
        certificate_(budget.is_certified ? longest_certificate(budget.picture_size) : ""),
        placer_(input),
        certifier_(
            input.volume, input.emission,
            {.size = budget.picture_size, .maxima_only = true, .progress = reporter.progress()}) {}

  /// How levels are placed, in turn: evenly, and where they err least if that is asked for or may
  /// pay. More levels for the same bytes often gain more.
  std::vector<std::string> placements() {
    if (!are_placed(flags_)) return {"explicit"};
    if (flags_.placement != "auto") return {flags_.placement};
    ordered_json unsaid;
    std::vector<std::string> placements{"uniform"};
    if (placer_.place(flags_, silent_, unsaid).placement == "optimal") {
      placements.emplace_back("optimal");
    }
    return placements;
  }

  SetSize build(const BudgetCandidate& candidate) {
    ShellFlags flags = flags_of(flags_, candidate);
    flags.coarse = kNoCopies;  // a budget is for what a scene needs at most
    ordered_json unsaid;
    BuildOptions options =
        build_options(flags, input_.volume.world_from_voxel, placer_.place(flags, silent_, unsaid),
                      reporter_.progress());
    options.scratch_folder = scratch_folder_;
    at_hand_ = build_and_compress(input_.volume, input_.emission, options, compression_of(flags));
    return {assemble_shell_set(at_hand_.compressed.set, at_hand_.compressed.shells,
                               {.certificate_json = certificate_})
                .size(),
            at_hand_.report.triangles};
  }

  double measure() {
    certifier_.restart();
    add_shells(at_hand_.compressed, reporter_.progress(), certifier_);
    return certifier_.result().max_fine.rmse;
  }

  void keep() { best_ = std::move(at_hand_); }

  /// The best set. How its levels were placed is said, as for any that is built; a coarse grid is
  /// not warned of where it was the trade's choice.
  BuiltSet take(const BudgetCandidate& chosen, BuildFigures& figures) {
    placer_.place(flags_of(flags_, chosen), reporter_, figures.placement);
    best_.report.is_grid_coarse = best_.report.is_grid_coarse && flags_.quantization > 0;
    return std::move(best_);
  }

 private:
  const ShellFlags& flags_;
  const EmissionVolume& input_;
  const std::filesystem::path& scratch_folder_;
  Reporter& reporter_;
  Reporter silent_{quiet_flags()};
  std::string certificate_;
  LevelPlacer placer_;
  Certifier certifier_;
  BuiltSet at_hand_;
  BuiltSet best_;
};

std::string quality(const BudgetTrial& trial) {
  if (!trial.rmse) return "does not fit";
  return *trial.rmse > 0.0 ? fmt::format("{:.2f} dB", psnr_db(*trial.rmse)) : "exact";
}

void say_trial(const BudgetTrial& trial, Reporter& reporter) {
  reporter.say(fmt::format("  {:>6} {:8} {:>9g} {:>4} {:>9} {:>9}  {}", trial.candidate.levels,
                           trial.candidate.placement, trial.candidate.tolerance,
                           trial.candidate.bits, trial.size.triangles, trial.size.bytes,
                           quality(trial)));
}

ordered_json trade_json(const Budget& budget, const BudgetTrade& trade) {
  ordered_json trials = ordered_json::array();
  for (std::size_t i = 0; i < trade.trials.size(); ++i) {
    const BudgetTrial& trial = trade.trials[i];
    ordered_json row{{"levels", trial.candidate.levels},
                     {"tolerance", trial.candidate.tolerance},
                     {"tolerance_weight", name(trial.candidate.weight)},
                     {"bits", trial.candidate.bits},
                     {"triangles", trial.size.triangles},
                     {"bytes", trial.size.bytes},
                     {"fits", trial.rmse.has_value()},
                     {"chosen", trade.chosen == i}};
    if (trial.rmse) {
      row["rmse"] = *trial.rmse;
      row["psnr_db"] = *trial.rmse > 0.0 ? ordered_json(psnr_db(*trial.rmse)) : ordered_json();
    }
    trials.push_back(std::move(row));
  }
  return {{"unit", budget.unit == Budget::Unit::Bytes ? "bytes" : "triangles"},
          {"most", budget.most},
          {"trials", std::move(trials)}};
}

[[noreturn]] void refuse(const Budget& budget, const std::vector<BudgetTrial>& trials) {
  const bool bytes = budget.unit == Budget::Unit::Bytes;
  const BudgetTrial& smallest = *std::ranges::min_element(
      trials, {},
      [&](const BudgetTrial& trial) { return bytes ? trial.size.bytes : trial.size.triangles; });
  throw Error(
      ErrorCode::BadArgument,
      fmt::format("--budget: found {}, expected {} or more, which the smallest set takes "
                  "({})",
                  budget_words(budget), bytes ? smallest.size.bytes : smallest.size.triangles,
                  words(smallest.candidate)));
}

}  // namespace

void check_budget(const std::string& budget) { parse_budget(budget); }

CompressedSet build_within_budget(const BudgetFlags& wish, const ShellFlags& flags,
                                  EmissionVolume input, const std::filesystem::path& scratch_folder,
                                  Reporter& reporter, BuildFigures& figures) {
  Stopwatch watch;
  const Budget budget = parse_budget(wish.budget);
  Trials trials(wish, flags, input, scratch_folder, reporter);
  reporter.say(fmt::format("budget {}: maximum projections over {} views of {}x{}",
                           budget_words(budget), certificate_views().size(), wish.picture_size.x,
                           wish.picture_size.y));
  reporter.say("  levels placed   tolerance bits triangles     bytes  PSNR");
  TrialSteps steps;
  steps.build = [&](const BudgetCandidate& candidate) { return trials.build(candidate); };
  steps.measure = [&] { return trials.measure(); };
  steps.keep = [&] { trials.keep(); };
  steps.tried = [&](const BudgetTrial& trial) { say_trial(trial, reporter); };
  BudgetTrade traded;
  for (const std::string& placement : trials.placements()) {
    const std::vector<BudgetCandidate> ladder =
        budget_ladder(input.volume.dims, input.volume.world_from_voxel,
                      held_by(flags, input.emission, budget.unit, placement));
    traded = trade(budget, ladder, steps, std::move(traded));
  }
  if (!traded.chosen) refuse(budget, traded.trials);
  const BudgetTrial& chosen = traded.trials[*traded.chosen];
  reporter.say(fmt::format("chosen: {}", words(chosen.candidate)));
  BuiltSet best = trials.take(chosen.candidate, figures);
  tell_build(best.compressed.set, best.report, reporter, figures);
  figures.budget = trade_json(budget, traded);
  figures.trade = watch.lap();
  count_crossings_of(best.compressed, reporter, figures);
  return std::move(best.compressed);
}

}  // namespace nacre
