#include "render/scene_facts.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace nacre {

Box bounds_of(std::span<const glm::vec3> positions) {
  if (positions.empty()) return {glm::dvec3(1.0), glm::dvec3(-1.0)};
  glm::vec3 lo = positions.front();
  glm::vec3 hi = lo;
  for (const glm::vec3& position : positions) {
    lo = glm::min(lo, position);
    hi = glm::max(hi, position);
  }
  return {glm::dvec3(lo), glm::dvec3(hi)};
}

SceneFacts scene_facts(const ShellSet& set, std::span<const Tool> tools) {
  SceneFacts facts;
  facts.center_mm = set.center_mm;
  facts.volume = set.volume;
  facts.shells.reserve(set.shells.size());
  for (const Shell& shell : set.shells) {
    facts.shells.push_back({shell.representative, shell.surface.triangles.size(),
                            bounds_of(shell.surface.positions), shell.sum_representative,
                            shell.emission});
  }
  for (const Tool& tool : tools) facts.tools.push_back(tool_facts(tool, set.center_mm));
  return facts;
}

ToolFacts tool_facts(const Tool& tool, const glm::dvec3& center_mm) {
  return {tool.mesh.triangles.size(), bounds_of(local_positions(tool, center_mm))};
}

std::vector<glm::vec3> local_positions(const Tool& tool, const glm::dvec3& center_mm) {
  std::vector<glm::vec3> positions;
  positions.reserve(tool.mesh.positions.size());
  for (const glm::vec3& position : tool.mesh.positions) {
    const glm::dvec3 world_mm(tool.world_from_tool * glm::dvec4(position, 1.0));
    positions.emplace_back(world_mm - center_mm);
  }
  return positions;
}

}  // namespace nacre
