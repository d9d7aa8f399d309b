#include "app/renderer_choice.h"

#include <fmt/core.h>

#include <optional>
#include <utility>

#include "core/error.h"
#include "render/cpu/cpu_renderer.h"
#include "render/gl/gl_renderer.h"

namespace nacre {
namespace {

constexpr const char* kCpu = "cpu";

PlannedRenderer with_plans(std::unique_ptr<ShellRenderer> renderer, const SceneFacts& scene,
                           std::span<const Camera> cameras, const RenderOptions& options) {
  PlannedRenderer planned{std::move(renderer), {}};
  for (const Camera& camera : cameras) {
    planned.plans.push_back(make_plan(scene, camera, options, planned.renderer->capabilities()));
  }
  return planned;
}

/// Why the processor does not draw one of the plans.
std::optional<std::string> objection(const PlannedRenderer& cpu) {
  for (const Plan& plan : cpu.plans) {
    if (auto found = cpu_objection(plan)) return found;
  }
  return std::nullopt;
}

/// A context in hardware, if there is one.
std::unique_ptr<ShellRenderer> hardware() {
  if (!may_have_hardware()) return nullptr;
  try {
    auto renderer = std::make_unique<GlRenderer>(Backend::Auto);
    if (!renderer->info().software) return renderer;
  } catch (const Error&) {  // none works: the processor may
  }
  return nullptr;
}

}  // namespace

void check_backend(const std::string& backend_name) {
  if (backend_name == kCpu || backend(backend_name)) return;
  throw Error(
      ErrorCode::BadArgument,
      fmt::format("--backend: found '{}', expected auto, egl, osmesa or cpu", backend_name));
}

PlannedRenderer open_renderer(const std::string& backend_name, double detail_px,
                              const SceneFacts& scene, std::span<const Camera> cameras,
                              const RenderOptions& options) {
  check_backend(backend_name);
  if (backend_name == "auto") {
    if (auto renderer = hardware()) {
      return with_plans(std::move(renderer), scene, cameras, options);
    }
  }
  if (backend_name == kCpu || backend_name == "auto") {
    PlannedRenderer cpu = with_plans(
        std::make_unique<CpuRenderer>(CpuOptions{.detail_px = detail_px}), scene, cameras, options);
    const auto found = objection(cpu);
    if (!found) return cpu;
    if (backend_name == kCpu) throw Error(ErrorCode::Unsupported, "backend cpu: " + *found);
  }
  return with_plans(std::make_unique<GlRenderer>(*backend(backend_name)), scene, cameras, options);
}

}  // namespace nacre
