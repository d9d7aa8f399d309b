#pragma once

// Parts of `make_plan`, one a kind of picture. Not part of the library's interface.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/plan.h"

namespace nacre::planning {

/// A shell that can show, and how rays meet its bounds.
struct ShownShell {
  std::uint32_t index = 0;
  std::size_t triangles = 0;
  double representative = 0.0;
  double step = 0.0;           ///< representative minus that of the shown shell around it
  Interval depths_mm = {};     ///< view depths of its bounds
  bool starts_inside = false;  ///< rays may start inside: eye or slab
  bool ends_inside = false;    ///< rays may end inside: tools or slab
  bool cut_by_slab = false;    ///< part of its bounds lies outside the slab
  bool reached = false;        ///< tools may hide part of it
};

/// What the parts read, and the plan they add to.
struct Planning {
  const SceneFacts& scene;
  const Camera& camera;
  const RenderOptions& options;
  RaySpan rays = {};                      ///< by eye and slab; infinite where neither ends them
  std::vector<std::uint32_t> tools = {};  ///< those in view
  std::vector<ShownShell> shells = {};    ///< outermost first
  Plan plan = {};

  void leave_out(std::string what, std::string_view why) {
    plan.left_out.push_back({std::move(what), std::string(why)});
  }

  void warn(std::string what) { plan.warnings.push_back(std::move(what)); }
};

/// "shells 2-4, 7 (1200 triangles)" for indices 1, 2, 3, 6, ascending.
std::string describe_shells(const SceneFacts& scene, const std::vector<std::uint32_t>& shells);

/// The same for shells that are shown.
std::string describe_shells(const Planning& planning, const std::vector<ShownShell>& shells);

/// Fills `tools`: those that any ray meets; plans the tool layer.
void find_tools(Planning& planning);

/// Fills `rays` and `shells`: those that add something to the picture.
void find_shells(Planning& planning);

/// A draw of the shell as rays and tools cut it.
ShellDraw draw_of(const ShownShell& shell, Faces faces);

/// Says which walls the pass does without, and why that is right for front and for back faces.
void note_faces(Planning& planning, const Pass& pass, std::string_view fronts_suffice,
                std::string_view backs_suffice);

/// Says which shells tools are not compared with.
void note_occlusion(Planning& planning);

void plan_max(Planning& planning);
void plan_crossings(Planning& planning);
void plan_lit(Planning& planning);

/// Warns where the scene goes past what the formats hold; after the passes are planned.
void note_limits(Planning& planning);

}  // namespace nacre::planning
