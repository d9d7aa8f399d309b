#include "app/tool_info.h"

#include <fmt/core.h>

#include "core/mesh_summary.h"
#include "io/tool_reader.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

ordered_json numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

std::string text(const glm::dvec3& v, const char* between) {
  return fmt::format("{:.6g}{}{:.6g}{}{:.6g}", v.x, between, v.y, between, v.z);
}

/// What the volume's sign says of the winding.
std::string winding(const MeshSummary& summary) {
  if (summary.open_edges > 0) return "unknown: the mesh is open";
  if (summary.signed_volume == 0.0) return "unknown: the mesh encloses nothing";
  return summary.signed_volume > 0.0 ? "outward" : "inward";
}

ordered_json to_json(const Tool& tool, const MeshSummary& summary) {
  ordered_json json;
  json["kind"] = "tool";
  json["name"] = tool.name;
  json["triangles"] = summary.triangles;
  json["vertices"] = summary.vertices;
  json["stored_vertices"] = tool.mesh.positions.size();
  json["unit"] = nullptr;  // no format states one
  json["bounds"] = {numbers(summary.lo), numbers(summary.hi)};
  json["extents"] = numbers(summary.hi - summary.lo);
  json["open_edges"] = summary.open_edges;
  json["non_manifold_edges"] = summary.non_manifold_edges;
  json["triangles_without_area"] = summary.without_area;
  json["signed_volume"] = summary.signed_volume;
  json["winding"] = winding(summary);
  json["peak_rss_bytes"] = peak_rss_bytes();
  return json;
}

void say(const MeshSummary& summary, Reporter& reporter) {
  reporter.say(
      fmt::format("tool         {} triangles, {} vertices", summary.triangles, summary.vertices));
  reporter.say(fmt::format("extents      {} file units", text(summary.hi - summary.lo, " x ")));
  reporter.say(fmt::format("bounds       {} to {} file units", text(summary.lo, ", "),
                           text(summary.hi, ", ")));
  reporter.say("unit         not stated by the file: --tool FILE,scale=S says how many mm one is");
  reporter.say(fmt::format(
      "edges        {} open, {} of more than two triangles{}", summary.open_edges,
      summary.non_manifold_edges,
      summary.open_edges + summary.non_manifold_edges == 0 ? ": closed and manifold" : ""));
  if (summary.without_area > 0) {
    reporter.say(
        fmt::format("             {} triangles with two equal corners", summary.without_area));
  }
  reporter.say(fmt::format("encloses     {:.6g} file units cubed, winding {}",
                           summary.signed_volume, winding(summary)));
}

}  // namespace

void run_tool_info(const std::string& path, Reporter& reporter) {
  const Tool tool = read_tool(path);
  const MeshSummary summary = summarize(tool.mesh);
  say(summary, reporter);
  reporter.finish(to_json(tool, summary));
}

}  // namespace nacre
