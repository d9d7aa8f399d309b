#include "render/scene_facts.h"

#include <glm/common.hpp>

namespace nacre {
namespace {

Box bounds_of(const TriangleMesh& surface) {
  if (surface.positions.empty()) return {glm::dvec3(1.0), glm::dvec3(-1.0)};
  glm::vec3 lo = surface.positions.front();
  glm::vec3 hi = lo;
  for (const glm::vec3& position : surface.positions) {
    lo = glm::min(lo, position);
    hi = glm::max(hi, position);
  }
  return {glm::dvec3(lo), glm::dvec3(hi)};
}

}  // namespace

SceneFacts scene_facts(const ShellSet& set) {
  SceneFacts facts;
  facts.center_mm = set.center_mm;
  facts.shells.reserve(set.shells.size());
  for (const Shell& shell : set.shells) {
    facts.shells.push_back(
        {shell.representative, shell.surface.triangles.size(), bounds_of(shell.surface)});
  }
  return facts;
}

}  // namespace nacre
