// `nacre reference`, and `nacre render --method exact`: the exact picture of a volume.
#include "app/exact_command.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <numbers>
#include <vector>

#include "app/thread_limit.h"
#include "core/volume_geometry.h"
#include "reference/exact_picture.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

struct Timing {
  double load = 0.0;
  double upload = 0.0;
  std::vector<double> frames;
  double write = 0.0;
};

ordered_json figures(const ExactFlags& flags, const EmissionVolume& input, const Image& image,
                     const Timing& timing) {
  const auto [least, greatest] = std::minmax_element(image.pixels.begin(), image.pixels.end());
  ordered_json json;
  json["backend"] = "exact";
  json["renderer"] = "exact walk of the trilinear field, double precision";
  json["mode"] = flags.picture.mode;
  json["window"] = {input.emission.lo(), input.emission.hi()};
  json["picture"] = {
      {"width", image.width}, {"height", image.height}, {"least", *least}, {"greatest", *greatest}};
  json["passes"] = {"walk every ray"};
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
  refuse_cue(flags.scene, "the exact walk");
  refuse_tools(flags.scene, "the exact walk");
  CameraOptions camera = camera_options(flags.camera);
  const ExactPictureOptions options{.mode = picture_mode(flags.picture),
                                    .slab = slab(flags.camera)};

  Timing timing;
  Stopwatch watch;
  const EmissionVolume input = read_emission_volume(flags.volume, reporter);
  timing.load = watch.lap();
  const BoundingSphere sphere = bounding_sphere(input.volume.dims, input.volume.world_from_voxel);
  make_camera(camera, sphere);  // refuses what cannot be, before the work
  const ExactWalk walk(input.volume, input.emission);
  timing.upload = watch.lap();

  const int views = std::max(flags.camera.turntable, 1);
  const double start = camera.azimuth_rad;
  Image image;
  for (int view = 0; view < views; ++view) {
    camera.azimuth_rad = start + 2.0 * std::numbers::pi * view / views;
    watch.lap();
    image = exact_picture(walk, make_camera(camera, sphere), options, reporter.progress()).volume;
    timing.frames.push_back(watch.lap());
    if (flags.picture.output.empty()) continue;
    write_picture(image, flags.picture, numbered_name(flags.picture.output, view));
    timing.write += watch.lap();
  }
  reporter.say(fmt::format("{} {} of {} x {} pixels, {:.1f} ms a frame (exact){}{}", views,
                           views == 1 ? "picture" : "pictures", image.width, image.height,
                           1e3 * median(timing.frames), flags.picture.output.empty() ? "" : " -> ",
                           flags.picture.output));
  reporter.finish(figures(flags, input, image, timing));
}

void add_reference_verb(CLI::App& app, int& /*status*/) {
  CLI::App* verb = app.add_subcommand("reference", "The exact picture of a volume");
  verb->footer("Example: nacre reference head.nii.gz --window 20,230 --view right -o head.tif");
  auto flags = std::make_shared<ExactFlags>();
  verb->add_option("VOLUME", flags->volume.path, "Volume file, or folder of a DICOM series")
      ->required();
  add_exact_flags(*verb, *flags);
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
