#include "report/shell_trial.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <set>
#include <utility>

#include "core/error.h"
#include "io/shell_reader.h"
#include "io/shell_writer.h"
#include "render/cpu/cpu_renderer.h"
#include "render/gl/gl_renderer.h"
#include "report/process_memory.h"
#include "shells/build.h"
#include "shells/prune.h"

namespace nacre {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Volume copy_of(const Volume& volume) {
  Volume copy = make_volume(volume.dims, volume.type);
  std::memcpy(copy.samples.data(), volume.samples.data(), volume.samples.size());
  copy.slope = volume.slope;
  copy.intercept = volume.intercept;
  copy.world_from_voxel = volume.world_from_voxel;
  return copy;
}

std::unique_ptr<ShellRenderer> open_backend_named(const std::string& backend_name) {
  if (backend_name == "cpu") return std::make_unique<CpuRenderer>();
  return std::make_unique<GlRenderer>(*backend(backend_name));
}

RenderOptions render_options_of(const Method& method, const MeasurementOptions& options) {
  RenderOptions render;
  render.mode = method.subject.mode;
  render.slab = options.slab;
  if (method.subject.cued) render.cue = options.cue;
  render.depth = method.depth;
  render.target = method.target;
  render.occlusion = method.occlusion;
  render.layers = Layers::Fine;  // as `nacre render`
  return render;
}

/// Why the processor does not draw one of the plans; empty if it does.
std::string objection_to(std::span<const Plan> plans) {
  for (const Plan& plan : plans) {
    if (const auto found = cpu_objection(plan)) return *found;
  }
  return "";
}

std::vector<std::uint32_t> drawn_in_any(const std::vector<const Plan*>& plans) {
  std::set<std::uint32_t> drawn;
  for (const Plan* plan : plans) {
    for (const std::uint32_t shell : shells_drawn(*plan)) drawn.insert(shell);
  }
  return {drawn.begin(), drawn.end()};
}

}  // namespace

EncodedShells encode_shells(const Volume& volume, const EmissionMap& emission,
                            const ShellRecipe& recipe) {
  BuildOptions build;
  build.levels = levels_of(recipe.levels);
  build.placement = recipe.levels.uniform > 0 ? "uniform" : "explicit";
  build.emission_tolerance = recipe.tolerance;
  build.quantization_bits = recipe.quantization_bits;
  build.min_component_mm3 = default_speck_mm3(volume.world_from_voxel);  // as `nacre build`
  EncodedShells encoded;
  const MemoryWatch memory;
  Volume copy = copy_of(volume);  // a build frees it when it has seen enough of it
  const auto start = Clock::now();
  std::vector<CompressedShell> shells(build.levels.size());
  const int effort = effort_for(recipe.tolerance > 0.0);  // as `nacre build`
  const BuiltShells built =
      build_shells(std::move(copy), emission, build,
                   [&](const ShellSet& set, std::size_t k, TriangleMesh&& surface) {
                     shells[k] = compress_shell(std::move(surface), *set.grid, effort);
                   });
  encoded.bytes = assemble_shell_set(built.set, shells);
  encoded.seconds = seconds_since(start);
  encoded.peak_bytes = memory.peak_bytes();
  return encoded;
}

ShellTrial::ShellTrial(const EncodedShells& shells, std::span<Measured* const> rows,
                       const MeasurementOptions& options)
    : options_(options) {
  const SceneFacts bare = scene_facts(decode_shell_set(shells.bytes, "shells"));
  SceneFacts with_tools = bare;
  for (const Tool& tool : options.tools) {
    with_tools.tools.push_back(tool_facts(tool, bare.center_mm));
  }
  for (Measured* row : rows) {
    open(*row);
    if (row->left_out.empty()) plan(*row, bare, with_tools);
    if (!row->left_out.empty()) continue;
    row->triangles = 0;
    for (const ShellFacts& shell : bare.shells) row->triangles += shell.triangles;
    drawable_.push_back(row);
  }
  for (auto& [backend_name, loaded] : loaded_) load(backend_name, shells);
}

void ShellTrial::open(Measured& row) {
  const std::string& backend_name = row.method.backend;
  if (const auto refused = refused_.find(backend_name); refused != refused_.end()) {
    row.left_out = refused->second;
    return;
  }
  if (loaded_.contains(backend_name)) return;
  try {
    loaded_[backend_name].renderer = open_backend_named(backend_name);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::Unsupported) throw;
    loaded_.erase(backend_name);
    row.left_out = refused_[backend_name] = error.what();
  }
}

void ShellTrial::plan(Measured& row, const SceneFacts& bare, const SceneFacts& with_tools) {
  const Method& method = row.method;
  const ShellRenderer& renderer = *loaded_.at(method.backend).renderer;
  std::vector<Plan> plans;
  try {
    for (const Camera& camera : options_.cameras) {
      plans.push_back(make_plan(method.subject.with_tool ? with_tools : bare, camera,
                                render_options_of(method, options_), renderer.capabilities()));
    }
  } catch (const Error& error) {  // the plan refuses what would be wrong: sums in 8 bits
    row.left_out = error.what();
    return;
  }
  if (method.backend == "cpu") row.left_out = objection_to(plans);
  if (!row.left_out.empty()) return;
  row.device = renderer.device_name();
  plans_[method.id] = std::move(plans);
}

void ShellTrial::load(const std::string& backend_name, const EncodedShells& shells) {
  std::vector<const Plan*> plans;
  std::vector<Measured*> rows;
  for (Measured* row : drawable_) {
    if (row->method.backend != backend_name) continue;
    rows.push_back(row);
    for (const Plan& plan : plans_.at(row->method.id)) plans.push_back(&plan);
  }
  if (rows.empty()) return;
  const bool normals = std::ranges::any_of(plans, [](const Plan* plan) { return plan->normals; });
  Loaded& loaded = loaded_.at(backend_name);
  const MemoryWatch memory;
  const auto start = Clock::now();
  {
    const ShellSet set = decode_shell_set(shells.bytes, "shells");
    loaded.renderer->upload(set, scene_facts(set), drawn_in_any(plans), {.normals = normals});
  }
  const bool tools =
      std::ranges::any_of(rows, [](const Measured* row) { return row->method.subject.with_tool; });
  if (tools) loaded.renderer->upload_tools(options_.tools);
  loaded.seconds = seconds_since(start);
  double ignored = 0.0;
  for (Measured* row : rows) {  // a driver's first picture is compiled before it is drawn
    draw(*row, 0, ignored);
    if (row == rows.front()) {
      for (Measured* other : rows) other->draw_peak_bytes = memory.peak_bytes();
    }
  }
}

Picture ShellTrial::draw(const Measured& row, std::size_t view, double& seconds) {
  ShellRenderer& renderer = *loaded_.at(row.method.backend).renderer;
  Picture picture = renderer.render(options_.cameras[view], plans_.at(row.method.id).at(view));
  seconds = renderer.last_frame().seconds;
  return picture;
}

double ShellTrial::load_seconds(const Measured& row) const {
  return loaded_.at(row.method.backend).seconds;
}

}  // namespace nacre
