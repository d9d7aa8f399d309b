#include "io/shell_file_json.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "core/checksum.h"
#include "core/error.h"
#include "core/quantization_grid.h"
#include "io/shell_file_format.h"

namespace nacre {
namespace {

using Json = nlohmann::ordered_json;  // keys in the order written, for people who look

// A shell alone is faint, many in a row add up.
constexpr double kAlpha = 0.15;
constexpr const char* kGenerator = "nacre " NACRE_VERSION;

/// An array of one element. (Nested braces would take it for something else.)
Json list_of(Json element) {
  Json list = Json::array();
  list.push_back(std::move(element));
  return list;
}

template <class Vector>
Json json_of(const Vector& v) {
  return {v.x, v.y, v.z};
}

Json json_of(const glm::dmat4& matrix) {
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) rows.push_back(matrix[column][row]);
  }
  return rows;
}

Json volume_json(const VolumeFacts& volume) {
  return {{"dims", json_of(volume.dims)},  {"world_from_voxel", json_of(volume.world_from_voxel)},
          {"type", name(volume.type)},     {"slope", volume.slope},
          {"intercept", volume.intercept}, {"checksum", checksum_text(volume.checksum)}};
}

Json grid_json(const QuantizationGrid& grid) {
  return {{"bits", grid.bits},
          {"origin_mm", json_of(grid.origin_mm)},
          {"range_mm", grid.range_mm},
          {"step_mm", step_mm(grid)}};
}

Json level_json(const Shell& shell, const std::optional<StoredShell>& stored,
                std::size_t mesh_index) {
  Json level = {{"emission", shell.emission},
                {"value", shell.value},
                {"representative", shell.representative},
                {"triangles", stored ? stored->counts.triangles : 0},
                {"vertices", stored ? stored->counts.vertices : 0}};
  if (shell.sum_representative) level["sum_representative"] = *shell.sum_representative;
  level["mesh"] = stored ? Json(mesh_index) : Json(nullptr);
  if (stored) level["checksum"] = checksum_text(stored->checksum);
  return level;
}

Json components_json(const ComponentCount& count) {
  return {{"components", count.components},
          {"triangles", count.triangles},
          {"volume_mm3", count.volume_mm3}};
}

Json pruned_json(const Pruning& pruned) {
  return {{"min_component_mm3", pruned.min_component_mm3},
          {"inner_pruned", pruned.inner_pruned},
          {"specks", components_json(pruned.specks)},
          {"inner", components_json(pruned.inner)},
          {"largest_emission", pruned.largest_emission}};
}

Json parsed_json(const std::string& text, std::string_view what) {
  Json value = Json::parse(text, nullptr, false);
  if (value.is_discarded()) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found '{:.60}', expected JSON", what, text));
  }
  return value;
}

Json coarse_level_json(const StoredShell& stored, std::size_t mesh_index) {
  return {{"mesh", mesh_index},
          {"triangles", stored.counts.triangles},
          {"vertices", stored.counts.vertices},
          {"checksum", checksum_text(stored.checksum)}};
}

/// Meshes are numbered in the order of their bytes: the shells', then the coarse copies'.
Json levels_json(const ShellSet& set, const StoredSet& stored) {
  Json levels = Json::array();
  std::size_t mesh_index = 0;
  for (std::size_t k = 0; k < set.shells.size(); ++k) {
    levels.push_back(level_json(set.shells[k], stored.shells[k], mesh_index));
    if (stored.shells[k]) ++mesh_index;
  }
  for (std::size_t k = 0; k < stored.coarse.shells.size(); ++k) {
    const auto& copy = stored.coarse.shells[k];
    if (copy) levels[k]["coarse"] = coarse_level_json(*copy, mesh_index++);
  }
  return levels;
}

Json coarse_json(const StoredCoarse& coarse) {
  Json json = {{"tolerance", coarse.tolerance}};
  const auto state = [&](const char* key, const std::string& error) {
    if (!error.empty()) json[key] = parsed_json(error, "coarse copies");
  };
  state("max", coarse.max_error_json);
  state("max_fine", coarse.max_fine_error_json);
  state("sum", coarse.sum_error_json);
  return json;
}

Json extras_json(const ShellSet& set, const StoredSet& stored,
                 const std::string& certificate_json) {
  Json nacre = {{"format", shell_file::kFormatVersion},
                {"volume", volume_json(set.volume)},
                {"emission", Json::array()},
                {"placement", set.placement},
                {"tolerance", set.tolerance},
                {"center_mm", json_of(set.center_mm)},
                {"grid", grid_json(*set.grid)},
                {"pruned", pruned_json(set.pruned)},
                {"levels", levels_json(set, stored)}};
  if (set.tolerance_weight != ToleranceWeight::Field) {
    nacre["tolerance_weight"] = name(set.tolerance_weight);
  }
  for (const EmissionKnot& knot : set.emission) {
    nacre["emission"].push_back({knot.value, knot.emission});
  }
  if (!stored.coarse.shells.empty()) nacre["coarse"] = coarse_json(stored.coarse);
  if (!certificate_json.empty()) {
    nacre["certificate"] = parsed_json(certificate_json, "certificate");
  }
  return {{"nacre", nacre}};
}

/// Column-major, as glTF has it: metres from millimetres, (X, Y, Z) = (L, S, -P) / 1000.
Json root_matrix() { return {0.001, 0, 0, 0, 0, 0, -0.001, 0, 0, 0.001, 0, 0, 0, 0, 0, 1}; }

Json primitive_json(std::size_t mesh_index) {
  return {{"attributes", {{"POSITION", 2 * mesh_index}}},
          {"indices", 2 * mesh_index + 1},
          {"material", mesh_index},
          {"mode", shell_file::kModeTriangles},
          {"extensions",
           {{shell_file::kDracoExtension,
             {{"bufferView", mesh_index}, {"attributes", {{"POSITION", 0}}}}}}}};
}

Json material_json(const std::string& name, double brightness) {
  return {{"name", name},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {brightness, brightness, brightness, kAlpha}},
            {"metallicFactor", 0},
            {"roughnessFactor", 1}}},
          {"alphaMode", "BLEND"},
          {"extensions", {{shell_file::kUnlitExtension, Json::object()}}}};
}

void append_mesh(Json& gltf, const std::string& name, const Shell& shell,
                 const StoredShell& stored) {
  const std::size_t mesh_index = gltf["meshes"].size();
  gltf["meshes"].push_back({{"name", name}, {"primitives", list_of(primitive_json(mesh_index))}});
  gltf["materials"].push_back(material_json(name, shell.representative));
  gltf["accessors"].push_back({{"componentType", shell_file::kComponentFloat},
                               {"count", stored.counts.vertices},
                               {"type", "VEC3"},
                               {"min", json_of(stored.lo)},
                               {"max", json_of(stored.hi)}});
  gltf["accessors"].push_back({{"componentType", shell_file::kComponentUint32},
                               {"count", 3 * stored.counts.triangles},
                               {"type", "SCALAR"}});
  gltf["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", stored.offset}, {"byteLength", stored.size}});
}

void append_shell(Json& gltf, const std::string& name, const Shell& shell,
                  const StoredShell& stored) {
  const std::size_t mesh_index = gltf["meshes"].size();  // members move when others are added
  gltf["nodes"].push_back({{"name", name}, {"mesh", mesh_index}});
  append_mesh(gltf, name, shell, stored);
}

/// No node refers to them: a viewer that knows nothing of them shows the shells alone.
void append_coarse(Json& gltf, const ShellSet& set, const StoredCoarse& coarse) {
  for (std::size_t k = 0; k < coarse.shells.size(); ++k) {
    if (!coarse.shells[k]) continue;
    append_mesh(gltf, fmt::format("coarse shell {}", k + 1), set.shells[k], *coarse.shells[k]);
  }
}

}  // namespace

std::string shell_file_json(const ShellSet& set, const StoredSet& stored,
                            const std::string& certificate_json) {
  Json gltf = {{"asset", {{"version", "2.0"}, {"generator", kGenerator}}},
               {"scene", 0},
               {"scenes", list_of({{"nodes", list_of(0)}})}};
  gltf["nodes"] = list_of({{"name", "shells"}, {"matrix", root_matrix()}});
  for (std::size_t k = 0; k < set.shells.size(); ++k) {
    if (!stored.shells[k]) continue;
    append_shell(gltf, fmt::format("shell {}", k + 1), set.shells[k], *stored.shells[k]);
  }
  append_coarse(gltf, set, stored.coarse);
  // glTF has no empty arrays, and no extension that nothing uses.
  const std::size_t node_count = gltf["nodes"].size();
  if (node_count > 1) {
    gltf["extensionsUsed"] = {shell_file::kDracoExtension, shell_file::kUnlitExtension};
    gltf["extensionsRequired"] = list_of(shell_file::kDracoExtension);
    gltf["buffers"] = list_of({{"byteLength", stored.binary_size}});
  }
  // Only now: members of an ordered object move when others are added.
  Json& root = gltf["nodes"][0];
  for (std::size_t i = 1; i < node_count; ++i) root["children"].push_back(i);
  root["extras"] = extras_json(set, stored, certificate_json);
  return gltf.dump();
}

}  // namespace nacre
