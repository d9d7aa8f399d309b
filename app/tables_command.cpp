// `nacre tables`: a paper's tables and figures, remade.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "app/output_folder.h"
#include "app/report_verbs.h"
#include "app/thread_limit.h"
#include "app/volume_flags.h"
#include "core/error.h"
#include "core/volume_geometry.h"
#include "datasets/phantom.h"
#include "extract/default_window.h"
#include "io/png_picture.h"
#include "report/h96_table.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

struct TablesFlags {
  CommonFlags common;
  std::string paper;
  std::string output;
  std::string hipip;
  std::string angiogram;
  std::string figures;  ///< file of the paper's own; empty: not at hand
  int views = 6;
};

/// A volume of the table, with what its values mean.
struct TableVolume {
  std::string data_set;
  std::string source;
  EmissionVolume input;
};

/// |psi|: the wave function shines in its lobes of both signs.
std::vector<EmissionKnot> both_signs(double largest) {
  return {{-largest, 1.0}, {0.0, 0.0}, {largest, 1.0}};
}

Volume phantom_or_file(const char* phantom, const std::string& path, Reporter& reporter) {
  if (path.empty()) return make_phantom(phantom, {}, reporter.progress());
  VolumeFlags flags;
  flags.path = path;
  return read_volume_of(flags, reporter).volume;
}

std::string source_words(const char* phantom, const std::string& path) {
  return path.empty() ? fmt::format("phantom {}", phantom) : fs::path(path).filename().string();
}

TableVolume hipip(const TablesFlags& flags, Reporter& reporter) {
  constexpr double kLargest = 255.0;  // of the published set, both signs
  return {"HIPIP", source_words("hipip", flags.hipip),
          map_volume(phantom_or_file("hipip", flags.hipip, reporter), both_signs(kLargest))};
}

TableVolume plume(Reporter& reporter) {
  return {"ground water",
          "phantom plume",
          {make_phantom("plume", {}, reporter.progress()), EmissionMap::window(0.0, 100.0)}};
}

TableVolume angiogram(const TablesFlags& flags, Reporter& reporter) {
  Volume volume = phantom_or_file("angiogram", flags.angiogram, reporter);
  const Window window = default_window(volume);
  return {"angiogram",
          source_words("angiogram", flags.angiogram),
          {std::move(volume), EmissionMap::window(window.lo, window.hi)}};
}

std::vector<Camera> cameras_about(const Volume& volume, int views) {
  const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
  std::vector<Camera> cameras;
  cameras.reserve(static_cast<std::size_t>(views));
  for (int view = 0; view < views; ++view) {
    cameras.push_back(make_camera({.azimuth_rad = 2.0 * std::numbers::pi * view / views}, sphere));
  }
  return cameras;
}

H96Case measured_case(const TableVolume& table, std::size_t levels, int views, Reporter& reporter) {
  const Volume& volume = table.input.volume;
  MeasurementOptions options;
  options.methods = h96_methods(levels);
  options.cameras = cameras_about(volume, views);
  constexpr double kSecondsACase = 20.0;
  options.budget_seconds = kSecondsACase;
  H96Case result{table.data_set, table.source,
                 fmt::format("{} x {} x {}", volume.dims.x, volume.dims.y, volume.dims.z), levels,
                 measure(volume, table.input.emission, options, reporter.progress())};
  for (const Measured& row : result.measured.rows) {
    if (!row.left_out.empty()) continue;
    reporter.say(
        fmt::format("{:<13} {:>2} shells  {:<12} {:>9} triangles {:8.2f} frames/s  {:6.2f} "
                    "dB lit",
                    table.data_set, levels, row.method.id, row.triangles,
                    1.0 / row.frame_seconds.median, row.error.lit.psnr_db));
  }
  return result;
}

std::vector<H96Case> measured_cases(const TablesFlags& flags, Reporter& reporter) {
  std::vector<H96Case> cases;
  {
    const TableVolume table = hipip(flags, reporter);
    cases.push_back(measured_case(table, 11, flags.views, reporter));
    cases.push_back(measured_case(table, 6, flags.views, reporter));
  }
  cases.push_back(measured_case(plume(reporter), 20, flags.views, reporter));
  cases.push_back(measured_case(angiogram(flags, reporter), 12, flags.views, reporter));
  return cases;
}

/// "hipip-11-max.png"
std::string picture_name(const H96Case& table_case, const char* mode) {
  std::string name = table_case.data_set;
  for (char& c : name) c = c == ' ' ? '-' : static_cast<char>(std::tolower(c));
  return fmt::format("{}-{}-{}.png", name, table_case.levels, mode);
}

nlohmann::ordered_json figures(const std::vector<H96Case>& cases) {
  auto json = nlohmann::ordered_json::array();
  for (const H96Case& table_case : cases) {
    for (const Measured& row : table_case.measured.rows) {
      if (!row.left_out.empty()) continue;
      json.push_back({{"data_set", table_case.data_set},
                      {"source", table_case.source},
                      {"levels", table_case.levels},
                      {"method", row.method.id},
                      {"triangles", row.triangles},
                      {"frame_seconds", row.frame_seconds.median},
                      {"rmse_lit", row.error.lit.rmse},
                      {"rmse_all", row.error.all.rmse},
                      {"max_error", row.error.all.max_error}});
    }
  }
  return {{"rows", json}};
}

std::vector<H96Figure> paper_figures(const std::string& path) {
  if (path.empty()) return {};
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw Error(ErrorCode::BadFile, fmt::format("{}: found no such file, expected CSV", path));
  }
  return read_h96_figures({std::istreambuf_iterator<char>(file), {}}, path);
}

void run_tables(const TablesFlags& flags) {
  Reporter reporter(flags.common);
  const ThreadLimit limit(flags.common);
  const std::vector<H96Figure> paper = paper_figures(flags.figures);
  OutputFolder folder(flags.output);
  const MachineFacts machine = machine_facts();
  const std::vector<H96Case> cases = measured_cases(flags, reporter);
  folder.write("h96.html", h96_page(cases, paper, machine));
  folder.write("h96.csv", h96_csv(cases, paper));
  for (const H96Case& table_case : cases) {
    folder.write(picture_name(table_case, "max"),
                 encode_png(h96_picture(table_case, PictureMode::Max)));
    const bool sums = std::ranges::any_of(table_case.measured.rows, [](const Measured& row) {
      return row.method.shells && row.left_out.empty() &&
             row.method.subject.mode == PictureMode::Sum;
    });
    if (!sums) continue;  // no OpenGL here
    folder.write(picture_name(table_case, "sum"),
                 encode_png(h96_picture(table_case, PictureMode::Sum)));
  }
  folder.commit();
  reporter.say(fmt::format("-> {}", (fs::path(flags.output) / "h96.html").string()));
  reporter.finish(figures(cases));
}

}  // namespace

void add_tables_verb(CLI::App& app, int& /*status*/) {
  CLI::App* verb = app.add_subcommand("tables", "A paper's tables and figures, remade");
  verb->footer("Example: nacre tables h96 -o h96");
  auto flags = std::make_shared<TablesFlags>();
  verb->add_option("PAPER", flags->paper,
                   "h96: frame rates of W. Heidrich, Hardware Accelerated Rendering of Emissive "
                   "Volumes (1996), table 1")
      ->required()
      ->check(CLI::IsMember({"h96"}));
  verb->add_option("-o,--output", flags->output,
                   "Folder of h96.html, h96.csv and pictures, made if need be")
      ->required();
  verb->add_option("--hipip", flags->hipip,
                   "The signed HIPIP data, -255 to 255 (default: the phantom hipip)");
  verb->add_option("--angiogram", flags->angiogram, "A scan (default: the phantom angiogram)");
  verb->add_option("--paper-figures", flags->figures,
                   "The paper's own figures, for the last column: CSV with the columns data_set, "
                   "levels, mode (maximum, summation), frames_per_s");
  verb->add_option("--turntable", flags->views, "N views about the up axis")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_common_flags(*verb, flags->common);
  verb->callback([flags] { run_tables(*flags); });
}

}  // namespace nacre
