// `nacre info`: what a file holds.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/certificate_words.h"
#include "app/command.h"
#include "app/tool_info.h"
#include "app/volume_flags.h"
#include "core/volume_geometry.h"
#include "extract/default_window.h"
#include "io/shell_reader.h"
#include "io/tool_reader.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

constexpr double kShearSaid = 0.001;  // radians; float matrices are sheared by 1e-6

struct InfoFlags {
  CommonFlags common;
  VolumeFlags volume;
};

/// Which way an axis runs in the patient: the nearest of L, R, P, A, S, I.
char direction_letter(const glm::dvec3& axis) {
  constexpr std::array<std::array<char, 2>, 3> kLetters{{{'R', 'L'}, {'A', 'P'}, {'I', 'S'}}};
  std::size_t largest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(axis[i]) > std::abs(axis[static_cast<int>(largest)])) {
      largest = static_cast<std::size_t>(i);
    }
  }
  return kLetters[largest][axis[static_cast<int>(largest)] > 0.0 ? 1 : 0];
}

std::string orientation(const glm::dmat4& world_from_voxel) {
  std::string letters;
  for (int axis = 0; axis < 3; ++axis) {
    letters += direction_letter(glm::dvec3(world_from_voxel[axis]));
  }
  return letters;
}

struct ValueRange {
  double least;
  double greatest;
};

/// In the volume's values.
ValueRange value_range(const Volume& volume) {
  return visit_samples(volume, [&](auto samples) {
    const auto [least, greatest] = std::minmax_element(samples.begin(), samples.end());
    const double a = volume.slope * static_cast<double>(*least) + volume.intercept;
    const double b = volume.slope * static_cast<double>(*greatest) + volume.intercept;
    return ValueRange{std::min(a, b), std::max(a, b)};
  });
}

ordered_json matrix_rows(const glm::dmat4& matrix) {
  ordered_json rows = ordered_json::array();
  for (int row = 0; row < 4; ++row) {
    rows.push_back({matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]});
  }
  return rows;
}

ordered_json to_json(const VolumeFile& file, const ValueRange& range, const Window& window) {
  const Volume& volume = file.volume;
  const glm::dvec3 spacing = spacing_mm(volume.world_from_voxel);
  const BoundingSphere sphere = bounding_sphere(volume.dims, volume.world_from_voxel);
  ordered_json json;
  json["kind"] = "volume";
  json["format"] = file.report.format;
  json["volume"] = {{"dims", {volume.dims.x, volume.dims.y, volume.dims.z}},
                    {"spacing_mm", {spacing.x, spacing.y, spacing.z}},
                    {"type", name(volume.type)}};
  json["slope"] = volume.slope;
  json["intercept"] = volume.intercept;
  json["range"] = {range.least, range.greatest};
  json["default_window"] = {window.lo, window.hi};
  json["orientation"] = orientation(volume.world_from_voxel);
  json["frame"] = "LPS, mm";
  json["world_from_voxel"] = matrix_rows(volume.world_from_voxel);
  json["center_mm"] = {sphere.center_mm.x, sphere.center_mm.y, sphere.center_mm.z};
  json["radius_mm"] = sphere.radius_mm;
  json["bytes"] = volume.samples.size();
  json["replaced"] = {{"nan", file.report.nan_count},
                      {"positive_infinity", file.report.positive_infinity_count},
                      {"negative_infinity", file.report.negative_infinity_count}};
  json["warnings"] = file.report.warnings;
  json["peak_rss_bytes"] = peak_rss_bytes();
  return json;
}

void say_volume(const VolumeFile& file, const ValueRange& range, const Window& window,
                Reporter& reporter) {
  const Volume& volume = file.volume;
  const glm::dmat4& matrix = volume.world_from_voxel;
  const glm::dvec3 spacing = spacing_mm(matrix);
  const BoundingSphere sphere = bounding_sphere(volume.dims, matrix);
  reporter.say(fmt::format("volume       {}, {} x {} x {} samples of {} ({} bytes)",
                           file.report.format, volume.dims.x, volume.dims.y, volume.dims.z,
                           name(volume.type), volume.samples.size()));
  reporter.say(fmt::format("values       {:.6g} to {:.6g} = {:.6g} * stored + {:.6g}", range.least,
                           range.greatest, volume.slope, volume.intercept));
  reporter.say(
      fmt::format("spacing      {:.6g} x {:.6g} x {:.6g} mm", spacing.x, spacing.y, spacing.z));
  const std::string letters = orientation(matrix);
  reporter.say(fmt::format("axes         x to {}, y to {}, z to {}{}{}", letters[0], letters[1],
                           letters[2], handedness(matrix) < 0.0 ? ", left-handed" : "",
                           shear_rad(matrix) > kShearSaid ? ", sheared" : ""));
  reporter.say(fmt::format("centre       {:.6g}, {:.6g}, {:.6g} mm (LPS), radius {:.6g} mm",
                           sphere.center_mm.x, sphere.center_mm.y, sphere.center_mm.z,
                           sphere.radius_mm));
  reporter.say(fmt::format("window       {:.6g},{:.6g} unless --window says otherwise", window.lo,
                           window.hi));
  for (int row = 0; row < 3; ++row) {
    reporter.say(fmt::format("{:<12} {:12.6g} {:12.6g} {:12.6g} {:12.6g}",
                             row == 0 ? "LPS from ijk" : "", matrix[0][row], matrix[1][row],
                             matrix[2][row], matrix[3][row]));
  }
}

ordered_json components_json(const ComponentCount& count) {
  return {{"components", count.components},
          {"triangles", count.triangles},
          {"volume_mm3", count.volume_mm3}};
}

ordered_json pruned_json(const Pruning& pruned) {
  return {{"min_component_mm3", pruned.min_component_mm3},
          {"inner_pruned", pruned.inner_pruned},
          {"specks", components_json(pruned.specks)},
          {"inner", components_json(pruned.inner)},
          {"largest_emission", pruned.largest_emission}};
}

void say_pruned(const Pruning& pruned, Reporter& reporter) {
  if (pruned.specks.components > 0) {
    reporter.say(
        fmt::format("left out     {} specks under {:.4g} mm3 ({:.4g} mm3), at most {:.3f} of "
                    "emission in a pixel",
                    pruned.specks.components, pruned.min_component_mm3, pruned.specks.volume_mm3,
                    pruned.largest_emission));
  }
  if (pruned.inner_pruned) {
    reporter.say(fmt::format(
        "left out     {} components inside their own shell ({:.4g} mm3): for maximum projections "
        "without slab only",
        pruned.inner.components, pruned.inner.volume_mm3));
  }
}

/// What a set's coarse copies take together.
struct CopiesSize {
  std::size_t triangles = 0;
  std::size_t bytes = 0;
};

CopiesSize copies_size(const ShellFileCoarse& coarse) {
  CopiesSize size;
  for (const std::optional<ShellFileLevel>& copy : coarse.levels) {
    if (!copy) continue;
    size.triangles += copy->triangles;
    size.bytes += copy->bytes;
  }
  return size;
}

ordered_json coarse_json(const ShellFileCoarse& coarse) {
  const CopiesSize size = copies_size(coarse);
  ordered_json json = {
      {"tolerance", coarse.tolerance}, {"triangles", size.triangles}, {"bytes", size.bytes}};
  if (!coarse.max_error_json.empty()) json["max"] = ordered_json::parse(coarse.max_error_json);
  if (!coarse.max_fine_error_json.empty()) {
    json["max_fine"] = ordered_json::parse(coarse.max_fine_error_json);
  }
  if (!coarse.sum_error_json.empty()) json["sum"] = ordered_json::parse(coarse.sum_error_json);
  return json;
}

void say_coarse(const ShellFileCoarse& coarse, Reporter& reporter) {
  const CopiesSize size = copies_size(coarse);
  reporter.say(fmt::format("copies       {} triangles, {} bytes, emission error {:.4g}",
                           size.triangles, size.bytes, coarse.tolerance));
  say_copies_error(coarse_json(coarse), reporter);
}

ordered_json to_json(const ShellFileInfo& info) {
  const ShellSet& set = info.set;
  ordered_json levels = ordered_json::array();
  for (std::size_t i = 0; i < info.levels.size(); ++i) {
    levels.push_back({{"emission", set.shells[i].emission},
                      {"value", set.shells[i].value},
                      {"representative", set.shells[i].representative},
                      {"triangles", info.levels[i].triangles},
                      {"vertices", info.levels[i].vertices},
                      {"bytes", info.levels[i].bytes}});
  }
  ordered_json json;
  json["kind"] = "shell set";
  json["format"] = fmt::format("glTF 2.0 binary, nacre {}", info.format_version);
  json["generator"] = info.generator;
  json["bytes"] = info.file_bytes;
  json["frame"] = "LPS, mm, relative to center_mm; the root node takes it to glTF metres, +Y up";
  json["center_mm"] = {set.center_mm.x, set.center_mm.y, set.center_mm.z};
  json["volume"] = {{"dims", {set.volume.dims.x, set.volume.dims.y, set.volume.dims.z}},
                    {"type", name(set.volume.type)},
                    {"world_from_voxel", matrix_rows(set.volume.world_from_voxel)}};
  json["window"] = {set.emission.front().value, set.emission.back().value};
  json["placement"] = set.placement;
  json["tolerance"] = set.tolerance;
  json["tolerance_weight"] = name(set.tolerance_weight);
  if (set.grid) json["quantization_bits"] = set.grid->bits;
  json["pruned"] = pruned_json(set.pruned);
  json["levels"] = levels;
  if (info.coarse) json["coarse"] = coarse_json(*info.coarse);
  if (!info.certificate_json.empty()) {
    json["certificate"] = ordered_json::parse(info.certificate_json);
  }
  return json;
}

void say_shells(const ShellFileInfo& info, Reporter& reporter) {
  const ShellSet& set = info.set;
  std::size_t triangles = 0;
  for (const ShellFileLevel& level : info.levels) triangles += level.triangles;
  reporter.say(fmt::format("shell set    {} levels ({}), {} triangles, {} bytes, {}",
                           info.levels.size(), set.placement, triangles, info.file_bytes,
                           info.generator));
  reporter.say(fmt::format("volume       {} x {} x {} samples of {}", set.volume.dims.x,
                           set.volume.dims.y, set.volume.dims.z, name(set.volume.type)));
  reporter.say(fmt::format("window       {:.6g},{:.6g}", set.emission.front().value,
                           set.emission.back().value));
  reporter.say(fmt::format("centre       {:.6g}, {:.6g}, {:.6g} mm (LPS)", set.center_mm.x,
                           set.center_mm.y, set.center_mm.z));
  if (set.grid) {
    reporter.say(fmt::format("grid         {} bits, {:.4g} mm a step", set.grid->bits,
                             set.grid->range_mm / (std::exp2(set.grid->bits) - 1.0)));
  }
  if (set.tolerance > 0.0) {
    const bool is_field = set.tolerance_weight == ToleranceWeight::Field;
    reporter.say(fmt::format("tolerance    {:.6g} of emission{}", set.tolerance,
                             is_field ? "" : ", less where maxima show more of it"));
  }
  say_pruned(set.pruned, reporter);
  if (info.coarse) say_coarse(*info.coarse, reporter);
  if (!info.certificate_json.empty()) {
    say_certificate(ordered_json::parse(info.certificate_json), reporter);
  }
  reporter.say("shell   emission       value    shown as   triangles    vertices       bytes");
  for (std::size_t i = 0; i < info.levels.size(); ++i) {
    const Shell& shell = set.shells[i];
    const ShellFileLevel& level = info.levels[i];
    reporter.say(fmt::format("{:>5} {:>10.6f} {:>11.6g} {:>11.6f} {:>11} {:>11} {:>11}", i + 1,
                             shell.emission, shell.value, shell.representative, level.triangles,
                             level.vertices, level.bytes));
  }
}

void run_info(const InfoFlags& flags) {
  Reporter reporter(flags.common);
  if (std::filesystem::path(flags.volume.path).extension() == ".glb") {
    const ShellFileInfo info = read_shell_file_info(flags.volume.path);
    say_shells(info, reporter);
    reporter.finish(to_json(info));
    return;
  }
  if (is_tool_name(flags.volume.path)) {
    run_tool_info(flags.volume.path, reporter);
    return;
  }
  const VolumeFile file = read_volume_of(flags.volume, reporter);
  const ValueRange range = value_range(file.volume);
  const Window window = default_window(file.volume);
  say_volume(file, range, window, reporter);
  reporter.finish(to_json(file, range, window));
}

}  // namespace

void add_info_verb(CLI::App& app, int& /*status*/) {
  CLI::App* verb = app.add_subcommand("info", "What a volume, a tool or a shell set holds");
  verb->footer("Example: nacre info head.nii.gz --json -");
  auto flags = std::make_shared<InfoFlags>();
  verb->add_option("FILE", flags->volume.path,
                   "Volume file, folder of a DICOM series, tool (.stl, .obj, .ply, .off), or shell "
                   "set (.glb)")
      ->required();
  add_volume_reading_flags(*verb, flags->volume);
  add_common_flags(*verb, flags->common);
  verb->callback([flags] { run_info(*flags); });
}

}  // namespace nacre
