#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "core/shell_set.h"

namespace nacre {

/// An axis-parallel box in LPS millimetres; empty if lo > hi along an axis.
struct Box {
  glm::dvec3 lo{0.0};
  glm::dvec3 hi{0.0};
};

/// What planning a picture needs to know of a shell: nothing that takes decoding it.
struct ShellFacts {
  double representative = 0.0;  ///< r_k, the emission shown for the layer above this shell
  std::size_t triangles = 0;    ///< 0 for a level that the volume does not reach
  Box bounds;                   ///< of the positions, relative to `SceneFacts::center_mm`
};

/// What planning a picture needs to know of a scene. A shell file's header holds all of it, so a
/// plan can say which shells need not be decoded.
struct SceneFacts {
  glm::dvec3 center_mm{0.0};  ///< LPS; bounds and positions are relative to it
  std::vector<ShellFacts> shells;
};

/// The facts of a set in memory. Looks at every position once.
SceneFacts scene_facts(const ShellSet& set);

}  // namespace nacre
