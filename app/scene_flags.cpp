#include "app/scene_flags.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "app/flag_values.h"
#include "core/error.h"
#include "io/pose_file.h"
#include "io/tool_reader.h"

namespace nacre {
namespace {

constexpr std::array<std::string_view, 3> kOptions{"pose=", "color=", "scale="};

/// A tool as its flag says it.
struct ToolFlag {
  std::string file;
  std::string pose;   ///< file; empty: none
  std::string color;  ///< "#rrggbb"; empty: one of the default ones
  std::string scale;  ///< empty: 1
};

[[noreturn]] void refuse(const std::string& found, std::string_view expected) {
  throw Error(ErrorCode::BadArgument,
              fmt::format("--tool: found '{}', expected {}", found, expected));
}

/// Whether a text begins with letters and '='.
bool is_option(std::string_view part) {
  const auto* const end =
      std::find_if(part.begin(), part.end(), [](unsigned char c) { return std::isalpha(c) == 0; });
  return end != part.begin() && end != part.end() && *end == '=';
}

ToolFlag parse_tool(const std::string& text) {
  ToolFlag flag;
  const std::array<std::string*, 3> values{&flag.pose, &flag.color, &flag.scale};
  std::string* current = &flag.file;
  bool first = true;
  for (const std::string& part : split(text, ',')) {
    const auto* const option = std::find_if(kOptions.begin(), kOptions.end(),
                                            [&](auto name) { return part.starts_with(name); });
    if (first) {
      *current = part;
    } else if (option != kOptions.end()) {
      current = values[static_cast<std::size_t>(option - kOptions.begin())];
      if (!current->empty()) refuse(text, "each of pose=, color= and scale= once");
      *current = part.substr(option->size());
      if (current->empty()) refuse(part, "something after the =");
    } else if (is_option(part)) {
      refuse(part, "FILE[,pose=FILE][,color=#rrggbb][,scale=S]");
    } else {
      *current += ',' + part;  // a comma in a name
    }
    first = false;
  }
  if (flag.file.empty()) refuse(text, "FILE[,pose=FILE][,color=#rrggbb][,scale=S]");
  return flag;
}

glm::vec3 parse_color(const std::string& text) {
  unsigned rgb = 0;
  const char* end = text.data() + text.size();
  bool good = text.size() == 7 && text[0] == '#';
  if (good) {
    const auto [stop, failure] = std::from_chars(text.data() + 1, end, rgb, 16);
    good = failure == std::errc{} && stop == end;
  }
  if (!good) refuse("color=" + text, "color=#rrggbb");
  return glm::vec3(rgb >> 16 & 0xffU, rgb >> 8 & 0xffU, rgb & 0xffU) / 255.0F;
}

double parse_scale(const std::string& text) {
  const double scale = parse_numbers("--tool scale", text, 1, "a number above 0")[0];
  if (!(scale >= 1e-9 && scale <= 1e9)) refuse("scale=" + text, "1e-9 to 1e9");
  return scale;
}

/// Okabe and Ito, "Color Universal Design" (2002), less black; the first is Tool's own light blue.
glm::vec3 default_color(std::size_t tool) {
  constexpr std::array<const char*, 6> kColors{"#e69f00", "#009e73", "#cc79a7",
                                               "#f0e442", "#d55e00", "#0072b2"};
  const std::size_t turn = tool % (kColors.size() + 1);
  return turn == 0 ? Tool{}.color : parse_color(kColors[turn - 1]);
}

/// Pictures are made in float: what lies so far off is a file gone wrong.
constexpr double kFarthestMm = 1e9;

void check_reach(const Tool& tool) {
  for (const glm::vec3& p : tool.mesh.positions) {
    const glm::dvec4 p_world = tool.world_from_tool * glm::dvec4(glm::dvec3(p), 1.0);
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(p_world[axis]) <= kFarthestMm)) {
        throw Error(ErrorCode::BadFile,
                    fmt::format("{}: found a vertex at {:.3g} mm, expected at most {:.0e} mm",
                                tool.name, p_world[axis], kFarthestMm));
      }
    }
  }
}

}  // namespace

void add_scene_flags(CLI::App& verb, SceneFlags& flags) {
  const std::string group = "Scene";
  verb.add_option("--cue", flags.cue,
                  "A,B,BETA0: emission is shown times BETA0 + (A z + B), z from 0 at the far end "
                  "of the volume to 1 at the near one")
      ->group(group);
  verb.add_option("--tool", flags.tools,
                  "FILE[,pose=FILE][,color=#rrggbb][,scale=S]: a surgical tool (.stl, .obj, .ply, "
                  ".off), may be repeated; pose: 16 numbers, row by row, to LPS mm; scale: mm a "
                  "file unit")
      ->allow_extra_args(false)
      ->group(group);
}

DepthCue depth_cue(const SceneFlags& flags) {
  if (flags.cue.empty()) return {};
  const auto numbers = parse_numbers("--cue", flags.cue, 3, "A,B,BETA0");
  const DepthCue cue{numbers[0], numbers[1], numbers[2]};
  check_cue(cue);
  return cue;
}

std::vector<Tool> read_tools(const SceneFlags& flags) {
  std::vector<Tool> tools;
  for (const std::string& text : flags.tools) {
    const ToolFlag flag = parse_tool(text);
    const glm::vec3 color =
        flag.color.empty() ? default_color(tools.size()) : parse_color(flag.color);
    const double scale = flag.scale.empty() ? 1.0 : parse_scale(flag.scale);
    const glm::dmat4 pose = flag.pose.empty() ? glm::dmat4(1.0) : read_pose(flag.pose);
    Tool tool = read_tool(flag.file);
    tool.color = color;
    tool.world_from_tool = glm::scale(pose, glm::dvec3(scale));
    check_reach(tool);
    tools.push_back(std::move(tool));
  }
  return tools;
}

}  // namespace nacre
