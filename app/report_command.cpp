// `nacre report`: error against run time.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/camera_flags.h"
#include "app/flag_values.h"
#include "app/output_folder.h"
#include "app/report_verbs.h"
#include "app/scene_flags.h"
#include "app/thread_limit.h"
#include "app/volume_flags.h"
#include "core/error.h"
#include "report/error_growth.h"
#include "report/measurement.h"
#include "report/needle.h"
#include "report/peer_process.h"
#include "report/report_page.h"
#include "report/report_tables.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

struct ReportFlags {
  CommonFlags common;
  VolumeFlags volume;
  CameraFlags camera;
  SceneFlags scene;
  std::string output;
  std::string only;
  std::string against;
  bool quick = false;
};

constexpr const char* kNeedle = "needle.stl";

/// A word as a shell reads it.
std::string quoted(const std::string& word) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:,=+-%@";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// The flag and its value, where it has one.
std::string flag(const char* name, const std::string& value) {
  return value.empty() ? "" : fmt::format(" {} {}", name, quoted(value));
}

std::string flag(const char* name, double value, double usual) {
  return value == usual ? "" : fmt::format(" {} {}", name, value);
}

std::string volume_text(const VolumeFlags& flags, const EmissionMap& emission) {
  std::string text = quoted(flags.path) + flag("--raw", flags.raw) + flag("--crop", flags.crop) +
                     flag("--series", flags.series);
  if (!flags.map.empty()) return text + flag("--map", flags.map);
  return text + fmt::format(" --window {},{}", emission.lo(), emission.hi());
}

std::string camera_text(const CameraFlags& flags, int views) {
  const CameraFlags usual;
  std::string text = fmt::format("--size {}", flags.size);
  if (flags.view != usual.view) text += flag("--view", flags.view);
  text += flag("--azimuth", flags.azimuth_deg, 0.0) +
          flag("--elevation", flags.elevation_deg, 0.0) + flag("--roll", flags.roll_deg, 0.0) +
          flag("--zoom", flags.zoom, 1.0);
  if (flags.has_perspective) text += fmt::format(" --perspective {}", flags.perspective_deg);
  if (flags.has_distance) text += fmt::format(" --distance {}", flags.distance_mm);
  text += flag("--look-at", flags.look_at) + flag("--slab", flags.slab);
  return text + fmt::format(" --turntable {}", views);
}

std::string tools_text(const ReportFlags& flags) {
  if (flags.scene.tools.empty()) {
    return fmt::format("--tool {}", quoted((fs::path(flags.output) / kNeedle).string()));
  }
  std::string text;
  for (const std::string& tool : flags.scene.tools) {
    text += fmt::format("{}--tool {}", text.empty() ? "" : " ", quoted(tool));
  }
  return text;
}

std::vector<Camera> cameras_of(const CameraFlags& flags, int views, const Volume& volume) {
  const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
  CameraOptions options = camera_options(flags);
  const double start = options.azimuth_rad;
  std::vector<Camera> cameras;
  for (int view = 0; view < views; ++view) {
    options.azimuth_rad = start + 2.0 * std::numbers::pi * view / views;
    cameras.push_back(make_camera(options, sphere));
  }
  return cameras;
}

/// Bytes of a file, or of all files in a folder.
std::size_t bytes_on_disk(const fs::path& path) {
  if (!fs::is_directory(path)) return static_cast<std::size_t>(fs::file_size(path));
  std::size_t bytes = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
    if (entry.is_regular_file()) bytes += static_cast<std::size_t>(entry.file_size());
  }
  return bytes;
}

std::string sample_words(const Volume& volume) {
  const glm::dvec3 spacing = spacing_mm(volume.world_from_voxel);
  return fmt::format("{} x {} x {} samples of {}, {:.3g} x {:.3g} x {:.3g} mm apart", volume.dims.x,
                     volume.dims.y, volume.dims.z, name(volume.type), spacing.x, spacing.y,
                     spacing.z);
}

/// The program of VTK's ray casters, which is beside this one where it was built.
std::string peer_program() {
  std::error_code unknown;
  const fs::path own = fs::read_symlink("/proc/self/exe", unknown);
  const fs::path program = own.parent_path() / "nacre_vtk_peers";
  return !unknown && fs::exists(program, unknown) ? program.string() : "";
}

/// Starts it on the volume and views of the report, where a method asks for it.
std::unique_ptr<PeerProcess> start_peers(const ReportFlags& flags, const CommandTexts& texts,
                                         std::span<const Method> methods, Reporter& reporter) {
  const auto asks = [](const Method& method) { return method.peer.has_value(); };
  if (std::ranges::none_of(methods, asks)) {
    reporter.detail("VTK's ray casters are not compared: not built, or not asked for");
    return nullptr;
  }
  std::string command =
      fmt::format("{} {} {} --serve -q", quoted(peer_program()), texts.volume, texts.camera);
  if (flags.common.threads > 0) command += fmt::format(" --threads {}", flags.common.threads);
  try {
    return std::make_unique<PeerProcess>(command);
  } catch (const Error& error) {
    reporter.detail(error.what());
    return nullptr;
  }
}

MeasurementOptions measurement_options(const ReportFlags& flags) {
  MeasurementOptions options;
  const std::vector<std::string> only =
      flags.only.empty() ? std::vector<std::string>{} : split(flags.only, ',');
  options.methods =
      report_methods({.quick = flags.quick, .with_peers = !peer_program().empty(), .only = only});
  options.slab = slab(flags.camera);
  if (!flags.scene.cue.empty()) options.cue = depth_cue(flags.scene);
  constexpr double kQuickSeconds = 60.0;
  constexpr double kSeconds = 600.0;
  options.budget_seconds = flags.quick ? kQuickSeconds : kSeconds;
  options.most_passes = flags.quick ? 2 : 7;
  return options;
}

std::string repeating_text(const ReportFlags& flags, const CommandTexts& texts) {
  std::string text = fmt::format("nacre report {} {}", texts.volume, texts.camera);
  if (flags.quick) text += " --quick";
  text += flag("--only", flags.only) + flag("--cue", flags.scene.cue);
  if (!flags.scene.tools.empty()) text += fmt::format(" {}", texts.tools);
  return text + flag("-o", flags.output);
}

ReportContext context_of(const ReportFlags& flags, const EmissionVolume& input, int views,
                         const DepthCue& cue) {
  ReportContext context;
  context.volume = fs::path(flags.volume.path).filename().string();
  context.samples = sample_words(input.volume);
  context.window = fmt::format("{:.6g} to {:.6g}", input.emission.lo(), input.emission.hi());
  context.views =
      fmt::format("{} {} of {} pixels", views, views == 1 ? "view" : "views", flags.camera.size);
  context.version = NACRE_VERSION;
  context.machine = machine_facts();
  context.commands = {.volume = volume_text(flags.volume, input.emission),
                      .camera = camera_text(flags.camera, views),
                      .tools = tools_text(flags),
                      .cue = cue};
  context.repeats_it = repeating_text(flags, context.commands);
  return context;
}

void say_outcome(const MeasurementResult& result, Reporter& reporter) {
  std::size_t left_out = 0;
  for (const Measured& row : result.rows) left_out += row.left_out.empty() ? 0 : 1;
  for (const Measured& row : result.rows) {
    if (!row.left_out.empty()) {
      reporter.detail(fmt::format("left out {}: {}", row.method.id, row.left_out));
      continue;
    }
    reporter.detail(fmt::format("{:<28} {:8.2f} ms  lit {:6.2f} dB  all {:6.2f} dB", row.method.id,
                                1e3 * row.frame_seconds.median, row.error.lit.psnr_db,
                                row.error.all.psnr_db));
  }
  reporter.say(fmt::format("{} methods measured in {} passes, {:.0f} s; {} left out",
                           result.rows.size() - left_out, result.passes, result.seconds, left_out));
}

/// The whole of a file.
std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw Error(ErrorCode::BadFile,
                fmt::format("{}: found no such file, expected a report's JSON", path));
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

int run_report(const ReportFlags& flags) {
  Reporter reporter(flags.common);
  const ThreadLimit limit(flags.common);
  MeasurementOptions options = measurement_options(flags);
  camera_options(flags.camera);  // refuses what cannot be, before the work
  const std::string earlier = flags.against.empty() ? "" : text_of_file(flags.against);
  OutputFolder folder(flags.output);
  Stopwatch watch;
  const EmissionVolume input = read_emission_volume(flags.volume, reporter);
  options.read_seconds = watch.lap();
  options.input_bytes = bytes_on_disk(flags.volume.path);

  constexpr int kQuickViews = 3;
  constexpr int kViews = 6;
  const int usual = flags.quick ? kQuickViews : kViews;
  const int views = flags.camera.turntable > 0 ? flags.camera.turntable : usual;
  options.cameras = cameras_of(flags.camera, views, input.volume);
  std::vector<Tool> tools = read_tools(flags.scene);
  if (tools.empty()) {
    const BoundingSphere sphere = bounding_sphere(input.volume.dims, input.volume.world_from_voxel);
    tools.push_back({.name = kNeedle, .mesh = needle(sphere)});
    folder.write(kNeedle, stl_bytes(tools.front().mesh));
  }
  options.tools = tools;
  const ReportContext context = context_of(flags, input, views, options.cue);
  const std::unique_ptr<PeerProcess> peers =
      start_peers(flags, context.commands, options.methods, reporter);
  options.peers = peers.get();
  keep_freed_memory();
  const MeasurementResult result =
      measure(input.volume, input.emission, options, reporter.progress());
  const std::string json = report_json(result, context);
  folder.write("report.html", report_page(result, context));
  folder.write("report.csv", report_csv(result));
  folder.write("report.json", json);
  folder.commit();
  say_outcome(result, reporter);
  reporter.say(fmt::format("-> {}", (fs::path(flags.output) / "report.html").string()));
  reporter.finish(nlohmann::ordered_json::parse(json));
  if (flags.against.empty()) return 0;
  const std::vector<std::string> grown = grown_errors(result, earlier, flags.against);
  for (const std::string& line : grown) reporter.warn(line);
  return grown.empty() ? 0 : 1;
}

}  // namespace

void add_report_verb(CLI::App& app, int& status) {
  CLI::App* verb = app.add_subcommand("report", "Error against run time, as a page with plots");
  verb->footer("Example: nacre report head.nii.gz --window 20,230 --quick -o report");
  auto flags = std::make_shared<ReportFlags>();
  verb->add_option("VOLUME", flags->volume.path, "Volume file, or folder of a DICOM series")
      ->required();
  verb->add_option("-o,--output", flags->output,
                   "Folder of report.html, report.csv and report.json, made if need be")
      ->required();
  verb->add_flag("--quick", flags->quick, "Fewer methods and views: about a minute, not ten");
  verb->add_option(
      "--only", flags->only,
      "PART,...: max, simplified, quantised, sum, iso, count, occlusion, depth, target");
  verb->add_option("--against", flags->against,
                   "report.json of an earlier run: exit 1 if an error grew by more than a tenth");
  add_scene_flags(*verb, flags->scene);
  add_camera_flags(*verb, flags->camera);
  add_volume_reading_flags(*verb, flags->volume);
  add_emission_flags(*verb, flags->volume);
  add_common_flags(*verb, flags->common);
  verb->callback([flags, &status] { status = run_report(*flags); });
}

}  // namespace nacre
