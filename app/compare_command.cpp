// `nacre compare`: how far one picture is from another.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/command.h"
#include "app/error_explaining.h"
#include "app/thread_limit.h"
#include "core/error.h"
#include "io/picture_file.h"
#include "io/png_picture.h"
#include "report/picture_error.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

struct CompareFlags {
  CommonFlags common;
  ExplainFlags explain;
  std::string picture;
  std::string truth;
  std::string output;
  std::optional<double> peak;
  std::optional<double> gain;
  std::optional<double> max_rmse;
  std::optional<double> min_psnr;
  std::string over = "all";
};

/// The two pictures, from files or made here.
struct Compared {
  PictureFile picture;
  PictureFile truth;
  std::string truth_name;
  std::optional<ErrorSplit> split;
};

/// 1 for emission; the truth's largest pixel where the unit has no natural peak.
double default_peak(const PictureFile& truth) {
  const auto& pixels = truth.image.pixels;
  const double largest = *std::max_element(pixels.begin(), pixels.end());
  const bool emission = truth.mode
                            ? *truth.mode == PictureMode::Max || *truth.mode == PictureMode::Iso
                            : largest <= 1;
  return emission || largest <= 0.0 ? 1.0 : largest;
}

/// JSON knows no infinity: equal pictures have a PSNR of null.
ordered_json to_json(const PictureError& error) {
  ordered_json json;
  json["pixels"] = error.pixels;
  json["rmse"] = error.rmse;
  json["psnr_db"] = std::isfinite(error.psnr_db) ? ordered_json(error.psnr_db) : ordered_json();
  json["max_error"] = error.max_error;
  json["bias"] = error.bias;
  return json;
}

std::string to_line(std::string_view name, const PictureError& error) {
  return fmt::format(
      "{:<4} {:>9} pixels   RMSE {:<11.4g} PSNR {:7.2f} dB   max error {:<10.4g} bias {:.2e}", name,
      error.pixels, error.rmse, error.psnr_db, error.max_error, error.bias);
}

/// Three times the lit pixels' RMSE in full colour: the usual error is seen, the rare one
/// saturates.
double default_gain(const PictureComparison& comparison) {
  const double usual = 3.0 * comparison.lit.rmse;
  if (usual > 0.0) return 1.0 / usual;
  return comparison.all.max_error > 0.0 ? 1.0 / comparison.all.max_error : 1.0;
}

void write_difference(const CompareFlags& flags, const Image& error,
                      const PictureComparison& comparison, Reporter& reporter) {
  if (picture_format(flags.output) == PictureFormat::Tiff) {
    write_measured_picture(error, PictureMode::Max, flags.output);
    reporter.say(fmt::format("difference (signed, as measured) -> {}", flags.output));
    return;
  }
  const double gain = flags.gain.value_or(default_gain(comparison));
  write_png(difference_picture(error, gain), flags.output);
  reporter.say(
      fmt::format("difference, {:.4g} times amplified (red: too bright, blue: too dark) -> {}",
                  gain, flags.output));
}

/// Whether the limits are kept; says which is not.
bool within_limits(const CompareFlags& flags, const PictureError& error, Reporter& reporter) {
  bool good = true;
  if (flags.max_rmse && error.rmse > *flags.max_rmse) {
    reporter.warn(fmt::format("RMSE {:.6g} over {} pixels is past --max-rmse {:.6g}", error.rmse,
                              flags.over, *flags.max_rmse));
    good = false;
  }
  if (flags.min_psnr && error.psnr_db < *flags.min_psnr) {
    reporter.warn(fmt::format("PSNR {:.2f} dB over {} pixels is under --min-psnr {:.2f}",
                              error.psnr_db, flags.over, *flags.min_psnr));
    good = false;
  }
  return good;
}

void warn_of_other_mode(const std::optional<PictureMode>& a, const std::optional<PictureMode>& b,
                        Reporter& reporter) {
  if (a && b && *a != *b) reporter.warn("the two pictures are of different modes");
}

Compared compare_files(const CompareFlags& flags, Reporter& reporter) {
  if (flags.picture.empty() || flags.truth.empty()) {
    throw Error(ErrorCode::BadArgument,
                "compare: found fewer than two pictures, expected PICTURE and TRUTH, or "
                "--explain-error");
  }
  Compared compared{read_picture(flags.picture), read_picture(flags.truth), flags.truth, {}};
  warn_of_other_mode(compared.picture.mode, compared.truth.mode, reporter);
  return compared;
}

Compared explained(const CompareFlags& flags, Reporter& reporter) {
  if (!flags.truth.empty()) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("compare: found the truth {}, expected none: --explain-error makes it",
                            flags.truth));
  }
  if (flags.explain.scene.camera.turntable > 0) {
    throw Error(ErrorCode::BadArgument, "--turntable: found several views, expected one");
  }
  std::optional<PictureFile> drawn;
  std::optional<Image> picture;
  if (!flags.picture.empty()) {
    drawn = read_picture(flags.picture);
    picture = drawn->image;
  }
  ExplainedError error = explain_error(flags.explain, std::move(picture), reporter);
  if (drawn) warn_of_other_mode(drawn->mode, error.mode, reporter);
  return {{std::move(error.picture), error.mode},
          {std::move(error.truth), error.mode},
          "the exact picture",
          std::move(error.split)};
}

std::string to_line(const ErrorPart& part) {
  return fmt::format("{:<20} {:>11.4g} {:>11.4g} {:>11.4g} {:>10.2f} %", part.cause, part.rmse_lit,
                     part.rmse, part.max_error, 100.0 * part.share);
}

void say_split(const ErrorSplit& split, Reporter& reporter) {
  reporter.say(fmt::format("{:<20} {:>11} {:>11} {:>11} {:>12}", "cause", "RMSE lit", "RMSE all",
                           "max error", "share"));
  for (const ErrorPart& part : split.parts) reporter.say(to_line(part));
  reporter.say(to_line(split.total));
  reporter.say(split.total.rmse > 0.0
                   ? fmt::format("{} dominates", split.parts[split.dominant].cause)
                   : std::string("there is no error"));
}

ordered_json to_json(const ErrorPart& part) {
  return {{"cause", part.cause},         {"rmse", part.rmse}, {"rmse_lit", part.rmse_lit},
          {"max_error", part.max_error}, {"bias", part.bias}, {"share", part.share}};
}

ordered_json to_json(const ErrorSplit& split) {
  ordered_json json;
  json["causes"] = ordered_json::array();
  for (const ErrorPart& part : split.parts) json["causes"].push_back(to_json(part));
  json["total"] = to_json(split.total);
  json["dominant"] =
      split.total.rmse > 0.0 ? ordered_json(split.parts[split.dominant].cause) : ordered_json();
  return json;
}

int run_compare(const CompareFlags& flags) {
  Reporter reporter(flags.common);
  const ThreadLimit limit(flags.common);
  if (!flags.output.empty()) picture_format(flags.output);
  const Compared compared =
      flags.explain.set.empty() ? compare_files(flags, reporter) : explained(flags, reporter);
  const Image& picture = compared.picture.image;
  const Image& truth = compared.truth.image;
  const PictureComparison comparison =
      compare_pictures(picture, truth, flags.peak.value_or(default_peak(compared.truth)));
  reporter.say(to_line("lit", comparison.lit));
  reporter.say(to_line("all", comparison.all));
  reporter.say(fmt::format("peak {:.6g}; largest error at pixel ({}, {}); lit: where {} is above 0",
                           comparison.peak, comparison.worst_x, comparison.worst_y,
                           compared.truth_name));
  if (compared.split) say_split(*compared.split, reporter);
  if (!flags.output.empty()) {
    write_difference(flags, difference(picture, truth), comparison, reporter);
  }
  const bool good =
      within_limits(flags, flags.over == "lit" ? comparison.lit : comparison.all, reporter);
  ordered_json figures = {{"all", to_json(comparison.all)},
                          {"lit", to_json(comparison.lit)},
                          {"peak", comparison.peak},
                          {"worst_pixel", {comparison.worst_x, comparison.worst_y}},
                          {"within_limits", good}};
  if (compared.split) {
    figures["error_split"] = to_json(*compared.split);
    figures["peak_rss_bytes"] = peak_rss_bytes();
  }
  reporter.finish(figures);
  return good ? 0 : 1;
}

}  // namespace

void add_compare_verb(CLI::App& app, int& status) {
  CLI::App* verb = app.add_subcommand("compare", "The error of a picture against another");
  verb->footer(
      "Example: nacre compare shells.tif exact.tif -o difference.png --min-psnr 45\n"
      "         nacre compare --explain-error head.glb --volume head.nii.gz --azimuth 30");
  auto flags = std::make_shared<CompareFlags>();
  verb->add_option("PICTURE", flags->picture, "Picture to judge (.tif, or a gray .png)");
  verb->add_option("TRUTH", flags->truth, "Picture it is judged against");
  verb->add_option("-o,--output", flags->output,
                   "Difference, signed: .png amplified in red and blue, .tif as measured");
  verb->add_option("--gain", flags->gain,
                   "Amplification of the difference in the PNG (default: three times the lit RMSE "
                   "is full colour)")
      ->check(CLI::PositiveNumber);
  verb->add_option("--peak", flags->peak,
                   "Brightness that PSNR is taken against (default: 1 for max, the truth's largest "
                   "pixel for sum)")
      ->check(CLI::PositiveNumber);
  verb->add_option("--max-rmse", flags->max_rmse, "Exit 1 if the RMSE is past this");
  verb->add_option("--min-psnr", flags->min_psnr, "Exit 1 if the PSNR (dB) is under this");
  verb->add_option("--over", flags->over, "Pixels that the limits are for: all or lit")
      ->check(CLI::IsMember({"all", "lit"}))
      ->capture_default_str();
  add_explain_flags(*verb, flags->explain);
  add_common_flags(*verb, flags->common);
  verb->callback([flags, &status] { status = run_compare(*flags); });
}

}  // namespace nacre
