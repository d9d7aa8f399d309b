#include "io/shell_directory.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/checksum.h"
#include "core/error.h"
#include "io/json_depth.h"
#include "io/shell_file_format.h"
#include "io/shell_set_rules.h"

namespace nacre {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxShownLength = 60;

/// A JSON value and the way to it, for messages: every access says what it expects.
class Value {
 public:
  Value(const json& value, std::string where, std::string_view file)
      : value_(&value), where_(std::move(where)), file_(file) {}

  [[noreturn]] void reject(const std::string& found, const std::string& expected) const {
    throw Error(ErrorCode::BadFile,
                fmt::format("{}: found {} at {}, expected {}", file_, found, where_, expected));
  }
  [[noreturn]] void expect(const std::string& expected) const {
    std::string shown = value_->dump(-1, ' ', true, json::error_handler_t::replace);
    if (shown.size() > kMaxShownLength) shown = shown.substr(0, kMaxShownLength) + "...";
    reject(shown, expected);
  }

  const json& raw() const { return *value_; }
  bool is_null() const { return value_->is_null(); }
  bool has(const char* key) const { return value_->is_object() && value_->contains(key); }

  Value operator[](const char* key) const {
    if (!value_->is_object()) expect("an object");
    const auto found = value_->find(key);
    const std::string where = where_.empty() ? key : fmt::format("{}.{}", where_, key);
    if (found == value_->end()) Value(*value_, where, file_).reject("nothing", "a value");
    return {*found, where, file_};
  }
  Value operator[](std::size_t index) const {
    if (!value_->is_array()) expect("an array");
    const std::string where = fmt::format("{}[{}]", where_, index);
    if (index >= value_->size()) Value(*value_, where, file_).reject("nothing", "a value");
    return {(*value_)[index], where, file_};
  }
  std::size_t length() const {
    if (!value_->is_array()) expect("an array");
    return value_->size();
  }
  Value sized(std::size_t size) const {
    if (length() != size) expect(fmt::format("{} values", size));
    return *this;
  }

  double number() const {
    if (!value_->is_number()) expect("a number");
    return value_->get<double>();
  }
  /// An integer from 0 to 2^53, what JSON carries safely.
  std::size_t count() const {
    const bool fits = value_->is_number_unsigned() && value_->get<std::uint64_t>() <= 1ULL << 53;
    if (!fits) expect("a count");
    return value_->get<std::size_t>();
  }
  bool truth() const {
    if (!value_->is_boolean()) expect("true or false");
    return value_->get<bool>();
  }
  std::string text() const {
    if (!value_->is_string()) expect("a string");
    return value_->get<std::string>();
  }
  std::uint64_t checksum() const {
    std::uint64_t value = 0;
    if (!parse_checksum(text(), value)) expect("16 hexadecimal digits");
    return value;
  }
  glm::dvec3 vector() const {
    sized(3);
    return {(*this)[std::size_t{0}].number(), (*this)[1].number(), (*this)[2].number()};
  }
  ScalarType scalar_type() const {
    const std::string found = text();
    for (int i = 0; i <= static_cast<int>(ScalarType::F64); ++i) {
      if (found == name(static_cast<ScalarType>(i))) return static_cast<ScalarType>(i);
    }
    expect("u8, i8, u16, i16, u32, i32, f32 or f64");
  }

 private:
  const json* value_;
  std::string where_;
  std::string_view file_;
};

json parsed(std::string_view text, std::string_view file) {
  if (is_json_too_deep(text)) {
    throw Error(ErrorCode::BadFile, fmt::format("{}: found JSON nested deeper than {}, expected a "
                                                "shell set",
                                                file, shell_file::kMaxJsonDepth));
  }
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    // "[json.exception.parse_error.101] parse error at ...: what": the last part says it.
    throw Error(ErrorCode::BadFile, fmt::format("{}: found malformed JSON ({:.200}), expected a "
                                                "shell set",
                                                file, error.what()));
  }
}

/// The object that makes a glTF file a shell set: `extras.nacre` of a node.
Value shell_set_extras(const Value& gltf, std::string_view file) {
  if (gltf.has("nodes")) {
    const Value nodes = gltf["nodes"];
    for (std::size_t i = 0; i < nodes.length(); ++i) {
      if (nodes[i].has("extras") && nodes[i]["extras"].has("nacre")) {
        return {nodes[i]["extras"]["nacre"].raw(), "extras.nacre", file};
      }
    }
  }
  throw Error(ErrorCode::BadFile,
              fmt::format("{}: found a glTF file without extras.nacre, expected a shell set that "
                          "nacre wrote",
                          file));
}

int checked_format(const Value& format, std::string_view file) {
  const std::size_t version = format.count();
  if (version == 0) format.expect("a format of 1 or more");
  if (version > shell_file::kFormatVersion) {
    throw Error(ErrorCode::Unsupported,
                fmt::format("{}: found a shell set of format {}, expected at most {} (it needs a "
                            "later nacre)",
                            file, version, shell_file::kFormatVersion));
  }
  return static_cast<int>(version);
}

VolumeFacts volume_of(const Value& volume) {
  VolumeFacts facts;
  const Value dims = volume["dims"].sized(3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    facts.dims[static_cast<int>(axis)] = static_cast<std::int64_t>(dims[axis].count());
  }
  const Value matrix = volume["world_from_voxel"].sized(16);
  for (std::size_t i = 0; i < 16; ++i) {
    facts.world_from_voxel[static_cast<int>(i % 4)][static_cast<int>(i / 4)] = matrix[i].number();
  }
  facts.type = volume["type"].scalar_type();
  facts.slope = volume["slope"].number();
  facts.intercept = volume["intercept"].number();
  facts.checksum = volume["checksum"].checksum();
  return facts;
}

QuantizationGrid grid_of(const Value& grid) {
  const std::size_t bits = grid["bits"].count();
  if (bits > 30) grid["bits"].expect("at most 30");
  return {grid["origin_mm"].vector(), grid["range_mm"].number(), static_cast<int>(bits)};
}

std::vector<EmissionKnot> knots_of(const Value& emission) {
  std::vector<EmissionKnot> knots(emission.length());
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const Value pair = emission[i].sized(2);
    knots[i] = {pair[std::size_t{0}].number(), pair[1].number()};
  }
  return knots;
}

ComponentCount components_of(const Value& count) {
  return {count["components"].count(), count["triangles"].count(), count["volume_mm3"].number()};
}

Pruning pruning_of(const Value& pruned) {
  return {pruned["min_component_mm3"].number(), pruned["inner_pruned"].truth(),
          components_of(pruned["specks"]), components_of(pruned["inner"]),
          pruned["largest_emission"].number()};
}

/// From a level's mesh to its bytes, by way of glTF.
ShellPayload payload_of(const Value& gltf, const Value& level, std::size_t binary_size) {
  ShellPayload payload;
  payload.checksum = level["checksum"].checksum();
  payload.counts = {level["triangles"].count(), level["vertices"].count()};
  const Value primitive =
      gltf["meshes"][level["mesh"].count()]["primitives"].sized(1)[std::size_t{0}];
  const Value accessors = gltf["accessors"];
  const Value positions = accessors[primitive["attributes"]["POSITION"].count()];
  payload.lo = positions["min"].vector();
  payload.hi = positions["max"].vector();
  const Value vertices = positions["count"];
  if (vertices.count() != payload.counts.vertices) vertices.expect("the level's vertices");
  const Value indices = accessors[primitive["indices"].count()]["count"];
  if (indices.count() != 3 * payload.counts.triangles) indices.expect("three a triangle");

  const Value view =
      gltf["bufferViews"]
          [primitive["extensions"][shell_file::kDracoExtension]["bufferView"].count()];
  if (view["buffer"].count() != 0) view["buffer"].expect("0, the file's own buffer");
  payload.offset = view.has("byteOffset") ? view["byteOffset"].count() : 0;
  payload.size = view["byteLength"].count();
  if (payload.offset > binary_size || payload.size > binary_size - payload.offset) {
    view.expect(fmt::format("a place within the {} bytes of the binary chunk", binary_size));
  }
  return payload;
}

ShellFileLevel file_level(const ShellPayload& payload) {
  return {payload.counts.triangles, payload.counts.vertices, payload.size, payload.lo, payload.hi};
}

void add_coarse(ShellDirectory& directory, const Value& gltf, const Value& level,
                std::size_t binary_size) {
  directory.coarse.emplace_back();
  std::optional<ShellFileLevel> stated;
  if (level.has("coarse")) {
    if (!directory.info.coarse)
      level["coarse"].expect("none where the set states no coarse copies");
    if (!directory.payloads.back()) level["coarse"].expect("none of an empty shell");
    directory.coarse.back() = payload_of(gltf, level["coarse"], binary_size);
    stated = file_level(*directory.coarse.back());
  }
  if (directory.info.coarse) directory.info.coarse->levels.push_back(stated);
}

void add_level(ShellDirectory& directory, const Value& gltf, const Value& level,
               std::size_t binary_size) {
  Shell shell;
  shell.emission = level["emission"].number();
  shell.value = level["value"].number();
  shell.representative = level["representative"].number();
  if (level.has("sum_representative")) {
    shell.sum_representative = level["sum_representative"].number();
  }
  directory.info.set.shells.push_back(std::move(shell));
  if (level["mesh"].is_null()) {
    directory.info.levels.emplace_back();
    directory.payloads.emplace_back();
    return;
  }
  const ShellPayload payload = payload_of(gltf, level, binary_size);
  directory.info.levels.push_back(file_level(payload));
  directory.payloads.emplace_back(payload);
}

/// One byte may stand for many triangles in one shell; the file as a whole is held to the same.
void check_total(const ShellDirectory& directory, std::size_t binary_size, std::string_view file) {
  std::size_t triangles = 0;
  const auto add = [&](const std::optional<ShellPayload>& payload) {
    if (!payload) return;
    triangles += std::min(payload->counts.triangles, plausible_triangles(binary_size) + 1);
    if (triangles > plausible_triangles(binary_size)) {
      throw Error(ErrorCode::BadFile,
                  fmt::format("{}: found {} or more triangles in {} bytes, expected at most {}",
                              file, triangles, binary_size, plausible_triangles(binary_size)));
    }
  };
  std::for_each(directory.payloads.begin(), directory.payloads.end(), add);
  std::for_each(directory.coarse.begin(), directory.coarse.end(), add);
}

ShellFileCoarse coarse_of(const Value& value) {
  ShellFileCoarse coarse;
  coarse.tolerance = value["tolerance"].number();
  if (!(coarse.tolerance >= 0.0)) value["tolerance"].expect("0 or more");
  if (value.has("max")) coarse.max_error_json = value["max"].raw().dump();
  if (value.has("max_fine")) coarse.max_fine_error_json = value["max_fine"].raw().dump();
  if (value.has("sum")) coarse.sum_error_json = value["sum"].raw().dump();
  return coarse;
}

ToleranceWeight weight_of(const Value& value) {
  for (const ToleranceWeight weight : {ToleranceWeight::Field, ToleranceWeight::Picture}) {
    if (value.text() == name(weight)) return weight;
  }
  value.expect("field or picture");
}

void read_description(ShellFileInfo& info, const Value& extras, std::string_view file) {
  info.format_version = checked_format(extras["format"], file);
  ShellSet& set = info.set;
  set.volume = volume_of(extras["volume"]);
  set.emission = knots_of(extras["emission"]);
  set.placement = extras["placement"].text();
  set.tolerance = extras["tolerance"].number();
  if (extras.has("tolerance_weight")) set.tolerance_weight = weight_of(extras["tolerance_weight"]);
  set.center_mm = extras["center_mm"].vector();
  set.grid = grid_of(extras["grid"]);
  // Files of earlier builds pruned nothing and say nothing of it.
  if (extras.has("pruned")) set.pruned = pruning_of(extras["pruned"]);
  if (extras.has("certificate")) info.certificate_json = extras["certificate"].raw().dump();
  if (extras.has("coarse")) info.coarse = coarse_of(extras["coarse"]);
}

}  // namespace

ShellDirectory parse_shell_directory(std::string_view text, std::size_t binary_size,
                                     std::string_view name) {
  const json document = parsed(text, name);
  const Value gltf(document, "", name);
  const Value version = gltf["asset"]["version"];
  if (version.text().substr(0, 2) != "2.") version.expect("glTF 2");
  const Value extras = shell_set_extras(gltf, name);

  ShellDirectory directory;
  if (gltf["asset"].has("generator")) {
    directory.info.generator = gltf["asset"]["generator"].text();
  }
  read_description(directory.info, extras, name);
  const Value levels = extras["levels"];
  for (std::size_t k = 0; k < levels.length(); ++k) {
    add_level(directory, gltf, levels[k], binary_size);
    add_coarse(directory, gltf, levels[k], binary_size);
  }
  check_total(directory, binary_size, name);
  if (const auto objection = shell_set_objection(directory.info.set)) {
    throw Error(ErrorCode::BadFile, fmt::format("{}: {}", name, *objection));
  }
  return directory;
}

}  // namespace nacre
