#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/camera.h"
#include "render/render_options.h"
#include "render/scene_facts.h"
#include "render/shell_renderer.h"

namespace nacre {

/// A renderer, and its plans for all views.
struct PlannedRenderer {
  std::unique_ptr<ShellRenderer> renderer;
  std::vector<Plan> plans;
};

/// Opens what --backend names.
///
/// `auto` is OpenGL where there is hardware for it, else the processor where it draws what the
/// plans ask for (the faster: docs/decisions/013-a-maximum-on-the-processor.md), else OpenGL in
/// software. No OpenGL library is loaded where none is needed.
///
/// @param detail_px  see `CpuOptions`
/// @throws Error     BadArgument for an unknown backend; Unsupported if it does not work here or
///                   does not draw what is asked for; as `make_plan` does
PlannedRenderer open_renderer(const std::string& backend, double detail_px, const SceneFacts& scene,
                              std::span<const Camera> cameras, const RenderOptions& options);

/// @throws Error  BadArgument unless it is a backend's name
void check_backend(const std::string& backend);

}  // namespace nacre
