#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/shell_set.h"
#include "core/tool.h"

namespace nacre {

/// An axis-parallel box in LPS millimetres; empty if lo > hi along an axis.
struct Box {
  glm::dvec3 lo{0.0};
  glm::dvec3 hi{0.0};
};

/// The box of positions; empty if there are none.
Box bounds_of(std::span<const glm::vec3> positions);

/// What planning a picture needs to know of a shell: nothing that takes decoding it.
struct ShellFacts {
  double representative = 0.0;  ///< r_k, the emission shown for the layer above this shell
  std::size_t triangles = 0;    ///< 0 for a level that the volume does not reach
  Box bounds;                   ///< of the positions, relative to `SceneFacts::center_mm`
  /// The emission that sums add for the layer; none where it is the representative.
  std::optional<double> sum_representative = std::nullopt;
  double emission = 0.0;  ///< level t_k
};

/// What planning a picture needs to know of a tool.
struct ToolFacts {
  std::size_t triangles = 0;
  Box bounds;  ///< of the posed positions, relative to `SceneFacts::center_mm`
};

/// What planning a picture needs to know of a scene. A shell file's header holds all that is said
/// of shells, so a plan can say which of them need not be decoded.
struct SceneFacts {
  glm::dvec3 center_mm{0.0};  ///< LPS; bounds and positions are relative to it
  std::vector<ShellFacts> shells;
  std::vector<ToolFacts> tools = {};
  VolumeFacts volume = {};  ///< beyond its box nothing shows, if one is stated
};

/// The facts of a set in memory. Looks at every position once.
SceneFacts scene_facts(const ShellSet& set, std::span<const Tool> tools = {});

/// The facts of a tool, relative to `center_mm`. Looks at every position once.
ToolFacts tool_facts(const Tool& tool, const glm::dvec3& center_mm);

/// Positions of a tool relative to `center_mm` (LPS mm): posed in double, then rounded to float, so
/// that a tool is as exact far from the world's origin as the shells are.
std::vector<glm::vec3> local_positions(const Tool& tool, const glm::dvec3& center_mm);

}  // namespace nacre
