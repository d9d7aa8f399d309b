// `nacre compare --explain-error`: which step from the volume to the picture costs how much.
#include "app/error_explaining.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "app/renderer_choice.h"
#include "core/error.h"
#include "core/volume_geometry.h"
#include "io/shell_reader.h"
#include "reference/tool_rays.h"
#include "report/shell_error.h"

namespace nacre {
namespace {

/// The volume that the set was made from: a map that rises and falls was applied to it.
Volume read_volume_for(const ExplainFlags& flags, Reporter& reporter) {
  const VolumeFlags& volume = flags.scene.volume;
  return volume.map.empty() ? read_volume_of(volume, reporter).volume
                            : read_emission_volume(volume, reporter).volume;
}

/// The picture that `nacre render --layers flat` makes.
Image draw(const ExplainFlags& flags, const ShellSet& set, std::span<const Tool> tools,
           const Camera& camera, const RenderOptions& options, Reporter& reporter) {
  const SceneFacts facts = scene_facts(set, tools);
  const auto [renderer, plans] =
      open_renderer(flags.draw.backend, flags.draw.detail_px, facts, {&camera, 1}, options);
  const Plan& plan = plans.front();
  if (flags.draw.explain) say_plan(plan, reporter);
  renderer->upload(set, facts, shells_drawn(plan), {.normals = plan.normals});
  renderer->upload_tools(tools);
  Image picture = renderer->render(camera, plan).volume;
  reporter.say(fmt::format("drawn by {}: {}", renderer->backend_name(), renderer->device_name()));
  return picture;
}

void check_size(const Image& picture, const Camera& camera) {
  if (picture.width == camera.size.x && picture.height == camera.size.y) return;
  throw Error(ErrorCode::BadArgument,
              fmt::format("picture: found {} x {} pixels, expected {} x {} (--size)", picture.width,
                          picture.height, camera.size.x, camera.size.y));
}

/// Pixels between the levels are no rasterisation of these shells.
void warn_of_smooth_layers(const Image& picture, const ShellSet& set, const RenderOptions& options,
                           Reporter& reporter) {
  if (options.mode != PictureMode::Max || !is_flat(options.cue)) return;
  std::set<float> shown{0.0F};
  for (const Shell& shell : set.shells) {
    shown.insert(static_cast<float>(beta(options.cue, 0.0) * shell.representative));
  }
  const auto between = std::count_if(picture.pixels.begin(), picture.pixels.end(),
                                     [&](float pixel) { return !shown.contains(pixel); });
  if (between == 0) return;
  reporter.warn(fmt::format(
      "picture: found {} pixels between the set's levels, expected --layers flat: what smooth "
      "layers change counts as rasterisation",
      between));
}

}  // namespace

ExplainedError explain_error(const ExplainFlags& flags, std::optional<Image> picture,
                             Reporter& reporter) {
  const std::vector<Tool> tools = read_tools(flags.scene.scene);
  const ShellFileInfo info = read_shell_file_info(flags.set);
  const RenderOptions options = render_options(flags.scene, flags.draw, info.set.shells.size());
  const Camera camera =
      make_camera(camera_options(flags.scene.camera),
                  bounding_sphere(info.set.volume.dims, info.set.volume.world_from_voxel));
  if (picture) {
    check_size(*picture, camera);
    warn_of_smooth_layers(*picture, info.set, options, reporter);
  }

  Volume volume = read_volume_for(flags, reporter);
  ShellSet set = read_shell_set(flags.set, {.progress = reporter.progress()});
  check_same_volume(volume, set.volume);
  if (!picture) picture = draw(flags, set, tools, camera, options, reporter);
  const ToolRays tool_rays(tools);
  ShellErrorChain chain = shell_error_chain(std::move(volume), std::move(set), camera,
                                            {.mode = options.mode,
                                             .cue = options.cue,
                                             .slab = options.slab,
                                             .hidden = options.hidden,
                                             .tools = &tool_rays},
                                            reporter.progress());
  chain.stages.push_back({"rasterisation", *picture});
  ErrorSplit split = split_error(chain.truth, chain.stages);
  return {std::move(*picture), std::move(chain.truth), options.mode, std::move(split)};
}

}  // namespace nacre
