// `nacre reference`, and `nacre render --method exact` and `sampled`: a picture of a volume by
// rays.
#include "app/exact_command.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "app/exact_scene.h"
#include "app/thread_limit.h"
#include "app/turntable_output.h"
#include "core/volume_geometry.h"
#include "reference/exact_walk.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

struct Timing {
  double load = 0.0;
  double upload = 0.0;
  std::vector<double> frames;
  std::size_t sampled = 0;  ///< of the frames
  double write = 0.0;
};

/// "exact", "2 a voxel", or, where some views are not of samples, "2 a voxel, 1 exact".
std::string how(const ExactScene& scene, const Timing& timing) {
  if (timing.sampled == 0) return "exact";
  const std::size_t exact = timing.frames.size() - timing.sampled;
  return fmt::format("{} a voxel", scene.samples()) +
         (exact > 0 ? fmt::format(", {} exact", exact) : std::string());
}

const char* pass_of(const ExactFlags& flags, const ExactScene& scene, const Timing& timing) {
  if (timing.sampled > 0) return "sample every bright brick";
  const bool by_cells = flags.picture.mode == "max" && !scene.shows_shells();
  return by_cells ? "draw every bright cell" : "walk every ray";
}

ordered_json figures(const ExactFlags& flags, const EmissionVolume& input, const ExactScene& scene,
                     const TurntableResult& result, const Timing& timing) {
  const Image& image = result.last.volume;
  const auto [least, greatest] = std::minmax_element(image.pixels.begin(), image.pixels.end());
  ordered_json json;
  json["backend"] = timing.sampled > 0 ? "sampled" : "exact";
  json["renderer"] =
      timing.sampled > 0
          ? fmt::format("samples of the trilinear field, {}, single precision", how(scene, timing))
          : std::string("exact walk of the trilinear field, double precision");
  json["mode"] = flags.picture.mode;
  json["window"] = {input.emission.lo(), input.emission.hi()};
  json["picture"] = {
      {"width", image.width}, {"height", image.height}, {"least", *least}, {"greatest", *greatest}};
  if (result.window) json["display"] = {result.window->lo, result.window->hi};
  if (scene.shows_shells()) json["levels"] = scene.level_figures();
  json["passes"] = {pass_of(flags, scene, timing)};
  json["left_out"] = ordered_json::array();
  json["triangles_drawn"] = 0;
  json["seconds"] = {{"load", timing.load},
                     {"plan", 0.0},
                     {"upload", timing.upload},
                     {"frames", timing.frames},
                     {"write", timing.write}};
  json["peak_rss_bytes"] = peak_rss_bytes();
  return json;
}

/// Median of frame times, for the line that is said.
double median(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 2];
}

}  // namespace

void run_exact(const ExactFlags& flags) {
  Reporter reporter(flags.common);
  const ThreadLimit limit(flags.common);
  check_output(flags.picture, flags.camera);
  CameraOptions camera = camera_options(flags.camera);

  Timing timing;
  Stopwatch watch;
  ExactScene scene(flags);
  const EmissionVolume input = read_emission_volume(flags.volume, reporter);
  scene.set_emission(input.emission);
  timing.load = watch.lap();
  const BoundingSphere sphere = bounding_sphere(input.volume.dims, input.volume.world_from_voxel);
  make_camera(camera, sphere);  // refuses what cannot be, before the work
  const ExactWalk walk(input.volume, input.emission);
  scene.prepare(walk);
  timing.upload = watch.lap();

  const int views = std::max(flags.camera.turntable, 1);
  const double start = camera.azimuth_rad;
  timing.frames.resize(static_cast<std::size_t>(views));
  const auto draw = [&](int view) {
    camera.azimuth_rad = start + 2.0 * std::numbers::pi * view / views;
    watch.lap();
    const Camera seen = make_camera(camera, sphere);
    Picture picture = scene.draw(walk, seen, reporter.progress());
    timing.frames[static_cast<std::size_t>(view)] = watch.lap();
    timing.sampled += scene.takes_samples(seen) ? 1 : 0;
    return picture;
  };
  const TurntableResult result =
      write_views(flags.picture, {.views = views, .tools = !flags.scene.tools.empty()}, draw);
  timing.write = result.write_seconds;
  const Image& image = result.last.volume;
  if (scene.samples() > 0 && timing.sampled == 0) {
    reporter.warn(
        "--method sampled: found a view or values that floats do not resolve, the exact picture is "
        "drawn");
  }
  reporter.say(fmt::format("{} {} of {} x {} pixels, {:.1f} ms a frame ({}){}{}", views,
                           views == 1 ? "picture" : "pictures", image.width, image.height,
                           1e3 * median(timing.frames), how(scene, timing),
                           flags.picture.output.empty() ? "" : " -> ", flags.picture.output));
  reporter.finish(figures(flags, input, scene, result, timing));
}

void add_reference_verb(CLI::App& app, int& /*status*/) {
  CLI::App* verb = app.add_subcommand("reference", "The exact picture of a volume");
  verb->footer("Example: nacre reference head.nii.gz --window 20,230 --view right -o head.tif");
  auto flags = std::make_shared<ExactFlags>();
  verb->add_option("VOLUME", flags->volume.path, "Volume file, or folder of a DICOM series")
      ->required();
  add_exact_flags(*verb, *flags);
  add_level_flags(*verb, flags->levels);
  verb->add_flag("--ideal", flags->ideal,
                 "Show ideal shells at the levels in max and sum: no error of triangles, depth or "
                 "quantisation")
      ->group("Shells");
  verb->callback([flags] { run_exact(*flags); });
}

void add_exact_flags(CLI::App& verb, ExactFlags& flags) {
  add_picture_flags(verb, flags.picture);
  add_scene_flags(verb, flags.scene);
  add_camera_flags(verb, flags.camera);
  add_volume_reading_flags(verb, flags.volume);
  add_emission_flags(verb, flags.volume);
  add_common_flags(verb, flags.common);
}

}  // namespace nacre
