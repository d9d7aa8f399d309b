// `nacre render` for shells: plan, decode what is drawn, upload, draw.
#include "app/shell_render.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "app/drawn_copies.h"
#include "app/flag_values.h"
#include "app/pruned_shells.h"
#include "app/renderer_choice.h"
#include "app/thread_limit.h"
#include "app/turntable_output.h"
#include "core/error.h"
#include "core/volume_geometry.h"
#include "io/shell_reader.h"
#include "render/gl/backends.h"
#include "render/shell_renderer.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

struct Timing {
  double load = 0.0;
  double plan = 0.0;
  double upload = 0.0;
  std::vector<double> frames;
  double write = 0.0;
};

/// What is to be drawn, from where: all that is known before anything is decoded.
struct Views {
  std::vector<Camera> cameras;
  RenderOptions options;
  std::optional<DrawnCopies> copies = {};
};

/// Shell numbers, counted from 1, as indices.
std::vector<std::uint32_t> shell_indices(std::string_view flag, const std::string& text,
                                         std::size_t shells) {
  std::vector<std::uint32_t> indices;
  for (const long long number : parse_integers(flag, text, 0, "shell numbers K,K,...")) {
    if (number < 1 || number > static_cast<long long>(shells)) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("{}: found shell {}, expected 1 to {}", flag, number, shells));
    }
    indices.push_back(static_cast<std::uint32_t>(number - 1));
  }
  return indices;
}

std::vector<std::uint32_t> hidden_shells(const DrawFlags& draw, std::size_t shells) {
  if (!draw.hide.empty()) return shell_indices("--hide", draw.hide, shells);
  if (draw.only.empty()) return {};
  const std::vector<std::uint32_t> shown = shell_indices("--only", draw.only, shells);
  std::vector<std::uint32_t> hidden;
  for (std::uint32_t shell = 0; shell < shells; ++shell) {
    if (std::find(shown.begin(), shown.end(), shell) == shown.end()) hidden.push_back(shell);
  }
  return hidden;
}

/// What a flag names, if it names anything.
template <class Value>
Value value_of(std::string_view flag, const std::optional<Value>& value, std::string_view found,
               std::string_view expected) {
  if (value) return *value;
  throw Error(ErrorCode::BadArgument,
              fmt::format("{}: found '{}', expected {}", flag, found, expected));
}

Views views_of(const ExactFlags& flags, const DrawFlags& draw, const VolumeFacts& volume,
               std::size_t shells) {
  Views views;
  views.options = render_options(flags, draw, shells);
  const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
  CameraOptions camera = camera_options(flags.camera);
  const double start = camera.azimuth_rad;
  const int count = std::max(flags.camera.turntable, 1);
  for (int view = 0; view < count; ++view) {
    camera.azimuth_rad = start + 2.0 * std::numbers::pi * view / count;
    views.cameras.push_back(make_camera(camera, sphere));
  }
  return views;
}

/// All that the plans of all views draw, ascending.
std::vector<std::uint32_t> drawn_in_any(const std::vector<Plan>& plans) {
  std::set<std::uint32_t> drawn;
  for (const Plan& plan : plans) {
    for (const std::uint32_t shell : shells_drawn(plan)) drawn.insert(shell);
  }
  return {drawn.begin(), drawn.end()};
}

/// Copies to the context what any of the plans needs.
void upload(ShellRenderer& renderer, const ShellSet& set, const SceneFacts& facts,
            std::span<const Tool> tools, const std::vector<Plan>& plans) {
  const bool normals =
      std::any_of(plans.begin(), plans.end(), [](const Plan& plan) { return plan.normals; });
  renderer.upload(set, facts, drawn_in_any(plans), {.normals = normals});
  renderer.upload_tools(tools);
}

ordered_json figures_of(const ShellRenderer& renderer, const ExactFlags& flags, const Views& views,
                        const Plan& plan, const TurntableResult& result, const Timing& timing) {
  const Image& image = result.last.volume;
  ordered_json json;
  json["backend"] = renderer.backend_name();
  json["renderer"] = renderer.device_name();
  json["mode"] = flags.picture.mode;
  json["picture"] = {{"width", image.width}, {"height", image.height}};
  if (result.window) json["display"] = {result.window->lo, result.window->hi};
  if (views.copies) {
    json["coarse"] = copies_json(*views.copies, picture_mode(flags.picture), layers_drawn(plan));
  }
  json["passes"] = ordered_json::array();
  for (const Pass& pass : plan.passes) json["passes"].push_back(describe(pass));
  json["left_out"] = ordered_json::array();
  for (const LeftOut& left : plan.left_out) {
    json["left_out"].push_back({{"what", left.what}, {"why", left.why}});
  }
  json["layers"] = name(layers_drawn(plan));
  json["warnings"] = plan.warnings;
  json["triangles_drawn"] = renderer.last_frame().triangles;
  json["uploaded_bytes"] = renderer.uploaded_bytes();
  json["seconds"] = {{"load", timing.load},
                     {"plan", timing.plan},
                     {"upload", timing.upload},
                     {"frames", timing.frames},
                     {"write", timing.write}};
  json["peak_rss_bytes"] = peak_rss_bytes();
  return json;
}

/// What the plan of the view that crosses most limits warns of: other views' figures are much the
/// same.
void warn_of_limits(const std::vector<Plan>& plans, Reporter& reporter) {
  const auto most = std::max_element(plans.begin(), plans.end(), [](const Plan& a, const Plan& b) {
    return a.warnings.size() < b.warnings.size();
  });
  for (const std::string& warning : most->warnings) reporter.warn(warning);
}

/// Draws all views and writes their pictures.
void draw_views(ShellRenderer& renderer, const ExactFlags& flags, const DrawFlags& draw,
                const Views& views, const std::vector<Plan>& plans, Timing timing,
                Reporter& reporter) {
  if (draw.explain && views.copies) {
    say_copies(*views.copies, picture_mode(flags.picture), layers_drawn(plans.front()), reporter);
  }
  if (draw.explain) say_plan(plans.front(), reporter);
  warn_of_limits(plans, reporter);
  timing.frames.resize(plans.size());
  const auto draw_view = [&](int number) {
    const auto view = static_cast<std::size_t>(number);
    Picture picture = renderer.render(views.cameras[view], plans[view]);
    timing.frames[view] = renderer.last_frame().seconds;
    return picture;
  };
  const TurntableResult result = write_views(
      flags.picture, {.views = static_cast<int>(plans.size()), .tools = !flags.scene.tools.empty()},
      draw_view);
  timing.write = result.write_seconds;
  const Image& image = result.last.volume;
  std::vector<double> sorted = timing.frames;
  std::sort(sorted.begin(), sorted.end());
  reporter.say(fmt::format(
      "{} {} of {} x {} pixels, {:.1f} ms a frame, {} triangles ({}: {}){}{}", plans.size(),
      plans.size() == 1 ? "picture" : "pictures", image.width, image.height,
      1e3 * sorted[sorted.size() / 2], renderer.last_frame().triangles, renderer.backend_name(),
      renderer.device_name(), flags.picture.output.empty() ? "" : " -> ", flags.picture.output));
  reporter.finish(figures_of(renderer, flags, views, plans.back(), result, timing));
}

/// A file's facts, without decoding it, and those of the tools.
SceneFacts facts_of(const ShellFileInfo& info, std::span<const Tool> tools) {
  SceneFacts facts;
  facts.center_mm = info.set.center_mm;
  facts.volume = info.set.volume;
  for (std::size_t i = 0; i < info.levels.size(); ++i) {
    const ShellFileLevel& level = info.levels[i];
    facts.shells.push_back({info.set.shells[i].representative,
                            level.triangles,
                            {glm::dvec3(level.lo_mm), glm::dvec3(level.hi_mm)},
                            info.set.shells[i].sum_representative,
                            info.set.shells[i].emission});
  }
  for (const Tool& tool : tools) facts.tools.push_back(tool_facts(tool, facts.center_mm));
  return facts;
}

}  // namespace

void add_draw_flags(CLI::App& verb, DrawFlags& flags) {
  const std::string group = "Drawing shells";
  verb.add_option("--backend", flags.backend,
                  "auto, egl, osmesa or cpu (all but lit shells; sums and counts into 32f)")
      ->capture_default_str()
      ->group(group);
  verb.add_option("--depth-buffer", flags.depth_buffer, "16, 24 or 32f")
      ->capture_default_str()
      ->group(group);
  verb.add_option("--target", flags.target, "8, 16f or 32f: where sums and counts add up")
      ->capture_default_str()
      ->group(group);
  verb.add_option("--occlusion", flags.occlusion,
                  "How tools hide what is behind them in a maximum: passes, texture, or auto: the "
                  "texture, always exact and seldom the slower")
      ->capture_default_str()
      ->group(group);
  verb.add_option("--layers", flags.layers,
                  "Between the levels a maximum without a cue is estimated from the pixels around "
                  "(smooth), from nine rays a pixel (fine), or each layer shows one brightness "
                  "(flat)")
      ->capture_default_str()
      ->group(group);
  verb.add_option("--detail", flags.detail_px,
                  "PX: the cpu backend may move surfaces by this many pixels to draw fewer "
                  "triangles (0: none)")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber)
      ->group(group);
  auto* hide = verb.add_option("--hide", flags.hide,
                               "K,K,...: shells not shown, counted from 1, outermost first")
                   ->group(group);
  verb.add_option("--only", flags.only, "K,K,...: the only shells shown")
      ->excludes(hide)
      ->group(group);
  verb.add_flag("--explain", flags.explain, "Print what is drawn and what is left out, and why")
      ->group(group);
}

RenderOptions render_options(const ExactFlags& flags, const DrawFlags& draw, std::size_t shells) {
  RenderOptions options;
  options.mode = picture_mode(flags.picture);
  options.slab = slab(flags.camera);
  options.cue = depth_cue(flags.scene);
  options.hidden = hidden_shells(draw, shells);
  options.depth = value_of("--depth-buffer", depth_format(draw.depth_buffer), draw.depth_buffer,
                           "16, 24 or 32f");
  options.target = value_of("--target", target_format(draw.target), draw.target, "8, 16f or 32f");
  options.layers = value_of("--layers", layers(draw.layers), draw.layers, "fine, smooth or flat");
  options.occlusion =
      value_of("--occlusion", occlusion(draw.occlusion), draw.occlusion, "auto, passes or texture");
  return options;
}

void say_plan(const Plan& plan, Reporter& reporter) {
  for (const Pass& pass : plan.passes) reporter.say("draws    " + describe(pass));
  if (plan.passes.empty()) reporter.say("draws    nothing: the picture is black");
  if (!plan.layers.empty()) {
    reporter.say(fmt::format(
        "{:<8} {} layers: the maximum is estimated between their levels{}",
        name(layers_drawn(plan)), plan.layers.size(),
        plan.samples > 1 ? fmt::format(", from {0} x {0} rays a pixel", plan.samples) : ""));
  }
  for (const LeftOut& left : plan.left_out) {
    reporter.say(fmt::format("left out {}: {}", left.what, left.why));
  }
}

void run_shell_file(const ExactFlags& flags, const DrawFlags& draw) {
  Reporter reporter(flags.common);
  const ThreadLimit limit(flags.common);
  check_output(flags.picture, flags.camera);
  check_backend(draw.backend);
  Timing timing;
  Stopwatch watch;
  const std::vector<Tool> tools = read_tools(flags.scene);
  ShellFileInfo info = read_shell_file_info(flags.volume.path);
  Views views = views_of(flags, draw, info.set.volume, info.levels.size());
  if (draw.coarse) views.copies = take_copies(flags.volume.path, info);
  check_pruning(info.set, views.options, views.cameras, reporter);
  timing.load = watch.lap();
  const SceneFacts facts = facts_of(info, tools);
  const auto [renderer, plans] =
      open_renderer(draw.backend, draw.detail_px, facts, views.cameras, views.options);
  const std::vector<std::uint32_t> drawn = drawn_in_any(plans);
  timing.plan = watch.lap();
  const ShellSet set = read_shell_set(
      flags.volume.path,
      {.wanted =
           [&](std::size_t shell) { return std::binary_search(drawn.begin(), drawn.end(), shell); },
       .coarse = draw.coarse,
       .progress = reporter.progress()});
  timing.load += watch.lap();
  upload(*renderer, set, facts, tools, plans);
  timing.upload = watch.lap();
  draw_views(*renderer, flags, draw, views, plans, timing, reporter);
}

void run_shells_of_volume(const ExactFlags& flags, const DrawFlags& draw,
                          const ShellFlags& shells) {
  Reporter reporter(flags.common);
  const ThreadLimit limit(flags.common);
  check_output(flags.picture, flags.camera);
  check_backend(draw.backend);
  Timing timing;
  Stopwatch watch;
  const std::vector<Tool> tools = read_tools(flags.scene);
  EmissionVolume input = read_emission_volume(flags.volume, reporter);
  BuildFigures figures;
  const ShellSet set = build_shell_set(shells, std::move(input), reporter, figures);
  const Views views = views_of(flags, draw, set.volume, set.shells.size());
  timing.load = watch.lap();
  const SceneFacts facts = scene_facts(set, tools);
  const auto [renderer, plans] =
      open_renderer(draw.backend, draw.detail_px, facts, views.cameras, views.options);
  timing.plan = watch.lap();
  upload(*renderer, set, facts, tools, plans);
  timing.upload = watch.lap();
  draw_views(*renderer, flags, draw, views, plans, timing, reporter);
}

void say_backends() {
  fmt::print("{:<7} {:<12} {:<9} maximum projections, sums and counts of shells\n", "cpu",
             "built in", "processor");
  const BackendList list = list_backends();
  for (const BackendInfo& info : list.working) {
    fmt::print("{:<7} {:<12} {:<9} {} ({})\n", name(info.backend), info.platform,
               info.software ? "software" : "hardware", info.renderer, info.version);
  }
  for (const LeftOut& left : list.not_working) {
    fmt::print("{:<20} not here: {}\n", left.what, left.why);
  }
}

}  // namespace nacre
