#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/camera.h"
#include "core/image.h"
#include "core/picture.h"
#include "core/shell_set.h"
#include "core/tool.h"
#include "core/volume_geometry.h"
#include "render/cpu/cpu_renderer.h"
#include "render/render_options.h"

namespace nacre::testing {

/// Marching cubes of a small angiogram: thin vessels, triangles below a pixel in size.
struct Scan {
  ShellSet set;
  BoundingSphere sphere;
};

Scan small_angiogram();

/// Orthographic, zoomed, perspective, and from within.
std::vector<Camera> cameras(const BoundingSphere& sphere, const glm::ivec2& size);

/// A tool that is moved to a place.
Tool tool_of(TriangleMesh mesh, const glm::dvec3& at, const glm::vec3& color);

/// A ball at a place along the view, in parts of the radius, and a rod across it.
std::vector<std::vector<Tool>> tools_about(const BoundingSphere& sphere, const Camera& camera);

/// No cue, near is bright, far is.
inline const std::array<DepthCue, 3> kCues{{{}, {0.8, 0.2, 0.0}, {-0.7, 0.9, 0.0}}};

/// Draws on the processor.
Picture draw(const ShellSet& set, std::span<const Tool> tools, const Camera& camera,
             const RenderOptions& options, const CpuOptions& how = {});

/// Slabs that start, end, or do both within the sphere.
std::vector<Slab> slabs(double radius_mm);

}  // namespace nacre::testing
