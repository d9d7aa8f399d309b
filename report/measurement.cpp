#include "report/measurement.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <utility>

#include "casting/sampled_maximum.h"
#include "core/error.h"
#include "reference/exact_picture.h"
#include "reference/exact_walk.h"
#include "reference/tool_rays.h"
#include "report/picture_series.h"
#include "report/process_memory.h"
#include "report/shell_trial.h"

namespace nacre {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr const char* kWalker = "exact walk of the trilinear field, double precision";
constexpr const char* kSampler = "samples of the trilinear field, single precision";

bool has_samples(const Measured& row) { return row.method.samples.has_value(); }

/// Times of one row over all passes.
struct Times {
  std::vector<double> build;
  std::vector<double> load;
  std::vector<double> frames;
};

/// A subject's exact pictures, for errors.
struct ExactViews {
  Image stacked;
  Truth truth;
};

void raise(std::optional<std::size_t>& peak, const std::optional<std::size_t>& bytes) {
  if (bytes) peak = std::max(peak.value_or(0), *bytes);
}

double peak_of(const Subject& subject, const Image& views) {
  const bool emission = subject.mode == PictureMode::Max || subject.mode == PictureMode::Iso;
  const float largest =
      views.pixels.empty() ? 0.0F : *std::max_element(views.pixels.begin(), views.pixels.end());
  return emission || largest <= 0.0F ? 1.0 : static_cast<double>(largest);
}

/// One run of `measure`.
class Measurement {
 public:
  Measurement(const Volume& volume, const EmissionMap& emission, const MeasurementOptions& options,
              const ProgressCallback& progress)
      : volume_(volume),
        emission_(emission),
        options_(options),
        progress_(progress),
        tools_(options.tools),
        walk_(volume, emission) {
    for (const Method& method : options.methods) {
      Measured row;
      row.method = method;
      rows_.push_back(std::move(row));
    }
    times_.resize(rows_.size());
    if (std::ranges::any_of(rows_, has_samples)) sampler_.emplace(walk_);
  }

  MeasurementResult run() {
    make_truths();
    meet_sampled();
    int pass = 0;
    double longest = 0.0;
    while (pass < options_.most_passes &&
           (pass == 0 || seconds_since(start_) + longest < options_.budget_seconds)) {
      const auto began = Clock::now();
      one_pass(pass);
      longest = std::max(longest, seconds_since(began));
      ++pass;
    }
    return result(pass);
  }

 private:
  void tell(int pass, double fraction) {
    if (!progress_) return;
    const std::string stage = pass < 0 ? "truth" : "pass " + std::to_string(pass + 1);
    progress_(stage, fraction);
  }

  ExactPictureOptions exact_options(const Subject& subject) const {
    ExactPictureOptions exact;
    exact.mode = subject.mode;
    exact.slab = options_.slab;
    if (subject.cued) exact.cue = options_.cue;
    if (subject.with_tool) exact.tools = &tools_;
    if (subject.mode == PictureMode::Count || subject.mode == PictureMode::Iso) {
      for (const Level& level : levels_of(subject.levels)) {
        exact.levels.push_back({emission_.value_at(level.emission), level.representative});
      }
    }
    return exact;
  }

  Picture exact_view(const Subject& subject, std::size_t view, double& seconds) const {
    const ExactPictureOptions exact = exact_options(subject);
    const auto start = Clock::now();
    Picture picture = exact_picture(walk_, options_.cameras[view], exact);
    seconds = seconds_since(start);
    return picture;
  }

  void make_truths() {
    for (const Measured& row : rows_) {
      const Subject& subject = row.method.subject;
      if (truths_.contains(subject)) continue;
      ExactViews exact;
      std::vector<Image> views;
      double ignored = 0.0;
      for (std::size_t view = 0; view < options_.cameras.size(); ++view) {
        Picture picture = exact_view(subject, view, ignored);
        views.push_back(picture.volume);
        if (view == 0) exact.truth.first_view = std::move(picture);
      }
      exact.stacked = stacked(views);
      exact.truth.subject = subject;
      exact.truth.peak = peak_of(subject, exact.stacked);
      truths_.emplace(subject, std::move(exact));
      tell(-1, static_cast<double>(truths_.size()) / static_cast<double>(rows_.size()));
    }
    tell(-1, 1.0);
  }

  Picture sampled_view(const Method& method, std::size_t view, double& seconds) const {
    SampledMaximumOptions sampled{.per_cell = *method.samples, .slab = options_.slab};
    if (method.subject.cued) sampled.cue = options_.cue;
    if (method.subject.with_tool) sampled.tools = &tools_;
    if (!sampler_->takes_samples(options_.cameras[view], sampled.cue)) {
      throw Error(ErrorCode::Unsupported,
                  "samples of this view: found none, the exact picture is "
                  "drawn instead");
    }
    const auto start = Clock::now();
    Picture picture = sampler_->picture(options_.cameras[view], sampled);
    seconds = seconds_since(start);
    return picture;
  }

  Picture peer_view(Measured& row, std::size_t view, double& seconds) {
    if (options_.peers == nullptr)
      throw Error(ErrorCode::Unsupported, "VTK's program did not start");
    PeerFrame frame = options_.peers->draw(*row.method.peer, view);
    row.device = frame.device;
    seconds = frame.seconds;
    Picture picture;
    picture.volume = std::move(frame.picture);
    return picture;
  }

  /// A view by samples along rays, here or in a peer.
  Picture view_of(Measured& row, std::size_t view, double& seconds) {
    return row.method.samples ? sampled_view(row.method, view, seconds)
                              : peer_view(row, view, seconds);
  }

  /// The pictures by samples and of peers, for their errors; what compiles or allocates at first
  /// has done it then.
  void meet_sampled() {
    for (Measured& row : rows_) {
      if (!is_sampled(row.method)) continue;
      try {
        meet(row);
      } catch (const Error& error) {
        if (error.code() != ErrorCode::Unsupported) throw;
        row.left_out = error.what();
      }
    }
  }

  void meet(Measured& row) {
    std::vector<Image> pictures;
    double ignored = 0.0;
    for (std::size_t view = 0; view < options_.cameras.size(); ++view) {
      Picture picture = view_of(row, view, ignored);
      pictures.push_back(picture.volume);
      if (view == 0) row.first_view = std::move(picture);
    }
    row.bytes = options_.input_bytes;
    judge(row, pictures);
  }

  Times& times_of(const Measured& row) {
    return times_[static_cast<std::size_t>(&row - rows_.data())];
  }

  /// Rows of shells by their recipe, in the order of the recipes' first rows.
  std::vector<std::vector<Measured*>> groups() {
    std::vector<std::vector<Measured*>> groups;
    for (Measured& row : rows_) {
      if (!row.method.shells || !row.left_out.empty()) continue;
      const auto same = std::ranges::find_if(groups, [&](const std::vector<Measured*>& group) {
        return group.front()->method.shells == row.method.shells;
      });
      if (same == groups.end()) {
        groups.push_back({&row});
      } else {
        same->push_back(&row);
      }
    }
    return groups;
  }

  void one_pass(int pass) {
    tell(pass, 0.0);
    prepare_walk(pass);
    prepare_sampler(pass);
    const auto all = groups();
    double done = 0.0;
    for (const std::vector<Measured*>& group : all) {
      measure_group(group, pass);
      tell(pass, ++done / static_cast<double>(all.size()));
    }
  }

  /// What the exact walk does before its first picture.
  void prepare_walk(int pass) {
    const MemoryWatch memory;
    const auto start = Clock::now();
    const ExactWalk again(volume_, emission_);
    const double seconds = seconds_since(start);
    exact_picture(again, options_.cameras.front());
    const auto peak = memory.peak_bytes();
    for (Measured& row : rows_) {
      if (is_exact(row.method)) prepared(row, kWalker, seconds, peak, pass);
    }
  }

  /// What samples need before their first picture: the walk, too.
  void prepare_sampler(int pass) {
    if (!sampler_) return;
    const MemoryWatch memory;
    const auto start = Clock::now();
    const ExactWalk walk(volume_, emission_);
    const SampledMaximum again(walk);
    const double seconds = seconds_since(start);
    again.picture(options_.cameras.front());
    const auto peak = memory.peak_bytes();
    for (Measured& row : rows_) {
      if (has_samples(row) && row.left_out.empty()) prepared(row, kSampler, seconds, peak, pass);
    }
  }

  /// A row that this program draws from the volume has been prepared.
  void prepared(Measured& row, const char* device, double seconds,
                const std::optional<std::size_t>& peak, int pass) {
    times_of(row).build.push_back(seconds);
    row.device = device;
    row.bytes = options_.input_bytes;
    raise(row.draw_peak_bytes, peak);
    if (pass == 0) times_of(row).load.push_back(options_.read_seconds);
  }

  void measure_group(const std::vector<Measured*>& group, int pass) {
    const EncodedShells shells = encode_shells(volume_, emission_, *group.front()->method.shells);
    ShellTrial trial(shells, group, options_);
    for (Measured* row : trial.rows()) {
      row->bytes = shells.bytes.size();
      raise(row->build_peak_bytes, shells.peak_bytes);
      times_of(*row).build.push_back(shells.seconds);
      times_of(*row).load.push_back(trial.load_seconds(*row));
    }
    std::map<const Measured*, std::vector<Image>> pictures;
    for (std::size_t view = 0; view < options_.cameras.size(); ++view) {
      for (Measured* row : trial.rows()) {
        double seconds = 0.0;
        Picture picture = trial.draw(*row, view, seconds);
        times_of(*row).frames.push_back(seconds);
        if (pass > 0) continue;
        pictures[row].push_back(picture.volume);
        if (view == 0) row->first_view = std::move(picture);
      }
      walk_beside(trial.rows(), view);
      samples_beside(trial.rows(), view);
    }
    for (Measured* row : trial.rows()) {
      if (pass == 0) judge(*row, pictures.at(row));
    }
  }

  /// Whether a row is of the subject and part of shells that were just drawn.
  static bool is_beside(const Measured& row, std::span<Measured* const> shown) {
    return std::ranges::any_of(shown, [&](const Measured* other) {
      return other->method.subject == row.method.subject && other->method.part == row.method.part;
    });
  }

  /// The exact walks of the subjects that shells were just drawn of: in the same moments.
  void walk_beside(std::span<Measured* const> shown, std::size_t view) {
    for (Measured& row : rows_) {
      if (!is_exact(row.method) || !is_beside(row, shown)) continue;
      double seconds = 0.0;
      exact_view(row.method.subject, view, seconds);
      times_of(row).frames.push_back(seconds);
    }
  }

  /// The pictures by samples and of peers of the same subjects, likewise.
  void samples_beside(std::span<Measured* const> shown, std::size_t view) {
    for (Measured& row : rows_) {
      if (!is_sampled(row.method) || !row.left_out.empty() || !is_beside(row, shown)) continue;
      double seconds = 0.0;
      view_of(row, view, seconds);
      times_of(row).frames.push_back(seconds);
    }
  }

  void judge(Measured& row, const std::vector<Image>& pictures) {
    const ExactViews& exact = truths_.at(row.method.subject);
    row.error = compare_pictures(stacked(pictures), exact.stacked, exact.truth.peak);
  }

  MeasurementResult result(int passes) {
    MeasurementResult result;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      Measured& row = rows_[i];
      const ExactViews& exact = truths_.at(row.method.subject);
      if (is_exact(row.method)) {
        row.error = compare_pictures(exact.stacked, exact.stacked, exact.truth.peak);
        row.first_view = exact.truth.first_view;
      }
      row.build_seconds = spread_of(times_[i].build);
      row.load_seconds = spread_of(times_[i].load);
      row.frame_seconds = spread_of(times_[i].frames);
    }
    result.rows = std::move(rows_);
    for (auto& [subject, exact] : truths_) result.truths.push_back(std::move(exact.truth));
    result.passes = passes;
    result.seconds = seconds_since(start_);
    return result;
  }

  const Volume& volume_;
  const EmissionMap& emission_;
  const MeasurementOptions& options_;
  const ProgressCallback& progress_;
  const ToolRays tools_;
  const ExactWalk walk_;
  std::optional<SampledMaximum> sampler_;  ///< if a method has samples
  std::vector<Measured> rows_;
  std::vector<Times> times_;
  std::map<Subject, ExactViews> truths_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

MeasurementResult measure(const Volume& volume, const EmissionMap& emission,
                          const MeasurementOptions& options, const ProgressCallback& progress) {
  return Measurement(volume, emission, options, progress).run();
}

}  // namespace nacre
