#include <fmt/core.h>

#include <algorithm>

#include "render/planning.h"

namespace nacre {
namespace {

/// "2-4, 7" for indices 1, 2, 3, 6.
std::string ranges(const std::vector<std::uint32_t>& shells) {
  std::string text;
  for (std::size_t first = 0; first < shells.size();) {
    std::size_t last = first;
    while (last + 1 < shells.size() && shells[last + 1] == shells[last] + 1) ++last;
    if (!text.empty()) text += ", ";
    text += first == last ? fmt::format("{}", shells[first] + 1)
                          : fmt::format("{}-{}", shells[first] + 1, shells[last] + 1);
    first = last + 1;
  }
  return text;
}

std::string_view what_happens(PassKind kind) {
  switch (kind) {
    case PassKind::ToolLayer: return "tools: colour and depth";
    case PassKind::MaxDepth: return "max as depth";
    case PassKind::MaxColor: return "max as depth and colour";
    case PassKind::StartCounts: return "shells around the start of rays, counted";
    case PassKind::EndCounts: return "shells around the end of rays, counted";
    case PassKind::Sum: return "sum of signed crossings";
    case PassKind::Count: return "count of crossings";
    case PassKind::Lit: break;
  }
  return "lit shells";
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace

std::size_t triangles(const Pass& pass) {
  std::size_t sum = pass.kind == PassKind::ToolLayer ? pass.tool_triangles : 0;
  for (const ShellDraw& draw : pass.draws) {
    sum += draw.triangles + (draw.tools == ToolCut::Passes ? pass.tool_triangles : 0);
  }
  return sum;
}

std::string describe(const Pass& pass) {
  const auto behind_tools =
      std::count_if(pass.draws.begin(), pass.draws.end(),
                    [](const ShellDraw& draw) { return draw.tools == ToolCut::Passes; });
  const auto compared =
      std::count_if(pass.draws.begin(), pass.draws.end(),
                    [](const ShellDraw& draw) { return draw.tools == ToolCut::Texture; });
  const std::string what = pass.kind == PassKind::ToolLayer ? counted(pass.tools.size(), "tool")
                                                            : counted(pass.draws.size(), "shell");
  return fmt::format(
      "{}: {}{}{}, {}", what_happens(pass.kind), what,
      behind_tools == 0 ? "" : fmt::format(", {} after the tools' depth", behind_tools),
      compared == 0 ? "" : fmt::format(", {} compared with the tools' depth", compared),
      counted(triangles(pass), "triangle"));
}

namespace planning {

std::string describe_shells(const SceneFacts& scene, const std::vector<std::uint32_t>& shells) {
  std::size_t triangles = 0;
  for (const std::uint32_t shell : shells) triangles += scene.shells[shell].triangles;
  return fmt::format("shell{} {} ({} triangles)", shells.size() == 1 ? "" : "s", ranges(shells),
                     triangles);
}

std::string describe_shells(const Planning& planning, const std::vector<ShownShell>& shells) {
  std::vector<std::uint32_t> indices;
  for (const ShownShell& shell : shells) indices.push_back(shell.index);
  return describe_shells(planning.scene, indices);
}

void note_faces(Planning& planning, const Pass& pass, std::string_view fronts_suffice,
                std::string_view backs_suffice) {
  for (const Faces faces : {Faces::Front, Faces::Back}) {
    std::vector<std::uint32_t> shells;
    for (const ShellDraw& draw : pass.draws) {
      if (draw.faces == faces) shells.push_back(draw.shell);
    }
    if (shells.empty()) continue;
    std::sort(shells.begin(), shells.end());
    const bool fronts = faces == Faces::Front;
    planning.leave_out(
        (fronts ? "back faces of " : "front faces of ") + describe_shells(planning.scene, shells),
        fronts ? fronts_suffice : backs_suffice);
  }
}

void note_occlusion(Planning& planning) {
  if (planning.tools.empty()) return;
  std::vector<ShownShell> untouched;
  for (const ShownShell& shell : planning.shells) {
    if (!shell.reached) untouched.push_back(shell);
  }
  if (untouched.empty()) return;
  planning.leave_out("tools against " + describe_shells(planning, untouched),
                     "no tool reaches their bounds");
}

}  // namespace planning
}  // namespace nacre
