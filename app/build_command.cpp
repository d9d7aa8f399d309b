// `nacre build`: a volume becomes a shell set.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "app/budget_building.h"
#include "app/camera_flags.h"
#include "app/certificate_words.h"
#include "app/set_certificate.h"
#include "app/shell_building.h"
#include "app/thread_limit.h"
#include "app/view_page.h"
#include "core/error.h"
#include "core/volume_geometry.h"
#include "io/atomic_file.h"
#include "io/shell_writer.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

constexpr const char* kNoCertificate = "none";
// Of the pictures a budget's sets are measured with where there is no certificate to agree with.
constexpr glm::ivec2 kTradedSize{256, 256};

struct BuildFlags {
  CommonFlags common;
  VolumeFlags volume;
  ShellFlags shells;
  std::string output;
  std::string certificate = "512x512";
  std::string budget;  ///< empty: none
};

std::size_t triangle_count(const CompressedSet& built) {
  std::size_t triangles = 0;
  for (const CompressedShell& shell : built.shells) triangles += shell.triangles;
  return triangles;
}

ordered_json level_list(const CompressedSet& built) {
  ordered_json levels = ordered_json::array();
  for (std::size_t k = 0; k < built.shells.size(); ++k) {
    const Shell& shell = built.set.shells[k];
    levels.push_back({{"emission", shell.emission},
                      {"value", shell.value},
                      {"representative", shell.representative},
                      {"sum_representative", sum_representative(shell)},
                      {"triangles", built.shells[k].triangles},
                      {"vertices", built.shells[k].vertices}});
  }
  return levels;
}

/// Null if there are no coarse copies.
ordered_json tell_coarse(const CompressedSet& built, const BuildFigures& figures,
                         Reporter& reporter) {
  if (!built.coarse) return {};
  std::size_t triangles = 0;
  std::size_t bytes = 0;
  for (const CompressedShell& copy : built.coarse->shells) {
    triangles += copy.triangles;
    bytes += copy.bytes.size();
  }
  reporter.say(fmt::format("copies       {} triangles, {} of these bytes, emission error {:.4g}",
                           triangles, bytes, built.coarse->tolerance));
  ordered_json json = {
      {"tolerance", built.coarse->tolerance}, {"triangles", triangles}, {"bytes", bytes}};
  json.update(figures.coarse_error);
  say_copies_error(json, reporter);
  return json;
}

void check_name(const std::string& output) {
  if (std::filesystem::path(output).extension() == ".glb") return;
  if (is_page_name(output)) return require_page(output);
  throw Error(ErrorCode::BadArgument,
              fmt::format("{}: found another ending, expected .glb or .html", output));
}

/// The set, or the page that shows it.
void write_output(AtomicFile& file, const std::string& output, std::span<const std::byte> set) {
  is_page_name(output) ? file.write(page_with_set(set)) : file.write(set);
  file.commit();
}

/// Null if none is wanted.
ordered_json certificate_of(const BuildFlags& flags, const CompressedSet& built, Reporter& reporter,
                            BuildFigures& figures) {
  if (flags.certificate == kNoCertificate) return {};
  const glm::ivec2 size = parse_size("--certificate", flags.certificate);
  ordered_json certificate = certify_set(flags.volume, size, built, reporter, figures);
  say_certificate(certificate, reporter);
  return certificate;
}

/// A budget is for what a scene needs at most, and holds for the file: it has no room for copies.
/// @throws Error  BadArgument for copies that cannot be, and for a budget with any
void check_copies(const BuildFlags& flags) {
  named_copies_tolerance(flags.shells);
  const std::string& coarse = flags.shells.coarse;
  if (flags.budget.empty() || coarse == kAutoCopies || coarse == kNoCopies) return;
  throw Error(ErrorCode::BadArgument,
              fmt::format("--coarse: found {} with --budget, expected one of them", coarse));
}

void check_certificate(const std::string& certificate) {
  if (certificate != kNoCertificate) parse_size("--certificate", certificate);
}

/// The flags of shells; a page, made to be sent, holds no copies that nobody asked for.
ShellFlags shell_flags(const BuildFlags& flags) {
  ShellFlags shells = flags.shells;
  if (shells.coarse == kAutoCopies && is_page_name(flags.output)) shells.coarse = kNoCopies;
  return shells;
}

CompressedSet build_set(const BuildFlags& flags, EmissionVolume input, Reporter& reporter,
                        BuildFigures& figures) {
  const std::filesystem::path folder = std::filesystem::path(flags.output).parent_path();
  if (flags.budget.empty()) {
    return build_compressed_set(shell_flags(flags), std::move(input), folder, reporter, figures);
  }
  BudgetFlags budget{.budget = flags.budget, .is_certified = flags.certificate != kNoCertificate};
  if (budget.is_certified) {
    budget.picture_size = parse_size("--certificate", flags.certificate);
  }
  return build_within_budget(budget, flags.shells, std::move(input), folder, reporter, figures);
}

void run_build(const BuildFlags& flags) {
  Reporter reporter(flags.common);
  const ThreadLimit limit(flags.common);
  check_name(flags.output);
  check_certificate(flags.certificate);
  check_copies(flags);
  if (flags.budget.empty()) {
    check_tolerance_weight(flags.shells);
  } else {
    check_budget(flags.budget);
  }
  AtomicFile file(flags.output);  // before the work, which a bad name would waste
  Stopwatch total;
  Stopwatch watch;
  EmissionVolume input = read_emission_volume(flags.volume, reporter);
  const double reading = watch.lap();
  BuildFigures figures;
  const CompressedSet built = build_set(flags, std::move(input), reporter, figures);
  const ShellSet& set = built.set;
  const ordered_json levels = level_list(built);
  for (const ordered_json& level : levels) reporter.detail("  " + level.dump());
  const ordered_json certificate = certificate_of(flags, built, reporter, figures);
  std::optional<CoarseShells> copies = built.coarse;
  if (copies && !figures.coarse_error.empty()) {
    copies->max_error_json = figures.coarse_error.at("max").dump();
    copies->max_fine_error_json = figures.coarse_error.at("max_fine").dump();
    copies->sum_error_json = figures.coarse_error.at("sum").dump();
  }
  const std::vector<std::byte> bytes = assemble_shell_set(
      set, built.shells,
      {.certificate_json = certificate.is_null() ? std::string() : certificate.dump(),
       .coarse = std::move(copies)});
  watch.lap();
  write_output(file, flags.output, bytes);
  const double writing = watch.lap();

  reporter.say(fmt::format("{} shells, {} triangles, {} bytes -> {}", set.shells.size(),
                           triangle_count(built), bytes.size(), flags.output));
  const ordered_json coarse = tell_coarse(built, figures, reporter);
  const glm::dvec3 spacing = spacing_mm(set.volume.world_from_voxel);
  ordered_json json;
  json["volume"] = {{"dims", {set.volume.dims.x, set.volume.dims.y, set.volume.dims.z}},
                    {"spacing_mm", {spacing.x, spacing.y, spacing.z}},
                    {"type", name(set.volume.type)}};
  json["window"] = {set.emission.front().value, set.emission.back().value};
  json["placement"] = set.placement;
  json["levels"] = levels;
  json["extracted_triangles"] = figures.extracted_triangles;
  json["triangles"] = triangle_count(built);
  json["bytes"] = bytes.size();
  if (!coarse.is_null()) json["coarse"] = coarse;
  json["left_out"] = figures.left_out;
  json["nesting"] = figures.nesting;
  if (!figures.placement.is_null()) json["predicted"] = figures.placement;
  if (!figures.budget.is_null()) json["budget"] = figures.budget;
  if (!certificate.is_null()) json["certificate"] = certificate;
  json["seconds"] = {{"read", reading},
                     {"emission", figures.emission},
                     {"extract", figures.extract},
                     {"simplify", figures.simplify},
                     {"coarsen", figures.coarsen},
                     {"encode", figures.encode},
                     {"crossings", figures.crossings},
                     {"trade", figures.trade},
                     {"certificate", figures.certificate},
                     {"write", writing},
                     {"total", total.lap()}};
  json["peak_rss_bytes"] = peak_rss_bytes();
  reporter.finish(json);
}

}  // namespace

void add_build_verb(CLI::App& app, int& /*status*/) {
  CLI::App* verb = app.add_subcommand(
      "build", "A volume becomes a shell set (.glb), or a page that shows it (.html)");
  verb->footer(
      "Example: nacre build head.nii.gz --window 20,230 --levels 48 -o head.glb\n"
      "         nacre build head.nii.gz --window 20,230 --tolerance 0.02 -o head.html\n"
      "         nacre build head.nii.gz --window 20,230 --budget 300kB -o head.glb");
  auto flags = std::make_shared<BuildFlags>();
  flags->shells.coarse = kAutoCopies;
  verb->add_option("VOLUME", flags->volume.path, "Volume file, or folder of a DICOM series")
      ->required();
  verb->add_option(
          "-o,--output", flags->output,
          "Shell set, .glb; or .html: a page that holds the set and shows it in a browser, offline")
      ->required();
  verb->add_option("--certificate", flags->certificate,
                   "WxH of the exact pictures that the set's error is measured with and stated in "
                   "the file; none: no certificate")
      ->capture_default_str();
  verb->add_option("--budget", flags->budget,
                   "The best set of at most so many bytes or triangles (2MB, 300kB, 300ktri): "
                   "levels, tolerance and bits by the measured error of maximum projections; what "
                   "--levels, --tolerance or --quantization name is held")
      ->group("Shells");
  add_shell_flags(*verb, flags->shells);
  add_compression_flag(*verb, flags->shells);
  verb->add_option(
          "--coarse", flags->shells.coarse,
          "Coarser copies of simplified shells in the file, for a first picture soon: none, the "
          "emission error they may have (above --tolerance), or auto (2 / levels, for a .glb of "
          "more than 200,000 triangles that they make at most 30 % larger)")
      ->capture_default_str()
      ->group("Shells");
  add_volume_reading_flags(*verb, flags->volume);
  add_emission_flags(*verb, flags->volume);
  add_common_flags(*verb, flags->common);
  verb->callback([flags] { run_build(*flags); });
}

}  // namespace nacre
