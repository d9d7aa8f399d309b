// The work of `nacre verify`, in builds that have the shell tools.
#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "app/thread_limit.h"
#include "app/verify_command.h"
#include "app/verify_report.h"
#include "core/error.h"
#include "core/quantization_grid.h"
#include "io/gltf_meshes.h"
#include "io/shell_reader.h"
#include "shells/voxel_checksum.h"
#include "shells/weld.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

/// A shell that cannot be decoded is a broken promise like others: the rest is checked all the
/// same.
void decode_shells(const VerifyFlags& flags, Reporter& reporter, VerifyFindings& findings) {
  const ShellFileInfo info = read_shell_file_info(flags.file);
  findings.set = info.set;
  if (info.coarse) {
    findings.warnings.emplace_back("the file's coarse copies were not checked, only its shells");
  }
  for (std::size_t k = 0; k < info.levels.size(); ++k) {
    findings.names.push_back(fmt::format("{}", k + 1));
    if (info.levels[k].bytes == 0) continue;
    try {
      ShellSet one = read_shell_set(flags.file, {.wanted = [k](std::size_t i) { return i == k; },
                                                 .progress = reporter.progress()});
      findings.set.shells[k].surface = std::move(one.shells[k].surface);
    } catch (const Error& error) {
      findings.broken.emplace_back(error.what());
    }
  }
}

/// Meshes of other writers, which know of no levels and no grid.
void decode_meshes(const VerifyFlags& flags, Reporter& reporter, VerifyFindings& findings) {
  GltfMeshes file = read_gltf_meshes(flags.file, reporter.progress());
  if (file.left_out > 0) {
    findings.warnings.push_back(
        fmt::format("{} primitives are no triangles, and were not checked", file.left_out));
  }
  for (GltfMesh& mesh : file.meshes) {
    Shell shell;
    shell.surface = weld(mesh.surface);
    findings.set.shells.push_back(std::move(shell));
    findings.names.push_back(std::move(mesh.name));
  }
}

void judge_surfaces(VerifyFindings& findings) {
  for (std::size_t k = 0; k < findings.surfaces.size(); ++k) {
    for (const std::string& promise : broken_promises(findings.surfaces[k])) {
      findings.broken.push_back(fmt::format("shell {}: found {}", findings.names[k], promise));
    }
  }
}

/// What is true of real scans, and good to know.
void warn_of_neighbours(VerifyFindings& findings) {
  std::size_t crossing = 0;
  std::size_t pairs = 0;
  std::size_t near = 0;
  const double step = findings.set.grid ? step_mm(*findings.set.grid) : 0.0;
  for (const ShellVerdict& verdict : findings.surfaces) {
    if (!verdict.next) continue;
    crossing += verdict.next->intersections.crossing;
    pairs += verdict.next->intersections.crossing > 0 ? 1 : 0;
    near += verdict.next->intersections.crossing == 0 && verdict.next->gap_mm < step ? 1 : 0;
  }
  if (crossing > 0) {
    findings.warnings.push_back(
        fmt::format("neighbouring shells cross: {} pairs of triangles between {} pairs of shells",
                    crossing, pairs));
  }
  if (near > 0) {
    findings.warnings.push_back(
        fmt::format("{} pairs of neighbouring shells come nearer than the grid's step of {:.4g} mm",
                    near, step));
  }
}

/// The volume a set was made from, as it was contoured.
Volume volume_for(const VerifyFlags& flags, Reporter& reporter) {
  if (flags.volume.map.empty()) return read_volume_of(flags.volume, reporter).volume;
  return read_emission_volume(flags.volume, reporter).volume;
}

/// Why a volume is not the one that a set was made from.
std::optional<std::string> other_volume(const ShellSet& set, const Volume& volume) {
  if (set.volume.dims != volume.dims) {
    return fmt::format("volume: found {} x {} x {} samples, expected {} x {} x {}", volume.dims.x,
                       volume.dims.y, volume.dims.z, set.volume.dims.x, set.volume.dims.y,
                       set.volume.dims.z);
  }
  if (set.volume.type != volume.type || voxel_checksum(volume) != set.volume.checksum) {
    return "volume: found other samples (by their checksum), expected those the set was made from";
  }
  if (set.volume.world_from_voxel != volume.world_from_voxel || set.volume.slope != volume.slope ||
      set.volume.intercept != volume.intercept) {
    return "volume: found another matrix, slope or intercept, expected the set's";
  }
  return std::nullopt;
}

void check_volume(const VerifyFlags& flags, Reporter& reporter, VerifyFindings& findings) {
  const Volume volume = volume_for(flags, reporter);
  if (const auto objection = other_volume(findings.set, volume)) {
    findings.broken.push_back(*objection);
    return;  // figures against another volume would say nothing
  }
  findings.against_volume = verify_against_volume(findings.set, volume, reporter.progress());
  for (std::size_t k = 0; k < findings.against_volume.size(); ++k) {
    const VolumeVerdict& verdict = findings.against_volume[k];
    if (verdict.tolerance_kept) continue;
    findings.broken.push_back(fmt::format(
        "shell {}: found an emission error of {:.4g} beside what snapping accounts for, "
        "expected at most the tolerance of {:.4g} or the {:.4g} of contouring",
        findings.names[k], verdict.emission.max_error_less_snapping, findings.set.tolerance,
        verdict.extraction_error_bound));
  }
}

void say(const VerifyFindings& findings, double seconds, Reporter& reporter) {
  for (const std::string& line : verify_table(findings)) reporter.say(line);
  for (const std::string& warning : findings.warnings) reporter.warn(warning);
  for (const std::string& promise : findings.broken) reporter.warn("broken: " + promise);
  std::size_t triangles = 0;
  for (const ShellVerdict& verdict : findings.surfaces) triangles += verdict.topology.triangles;
  reporter.say(fmt::format(
      "{} surfaces, {} triangles: {} ({:.1f} s)", findings.surfaces.size(), triangles,
      findings.broken.empty() ? "all promises kept"
                              : fmt::format("{} promises broken", findings.broken.size()),
      seconds));
}

}  // namespace

int run_verify(const VerifyFlags& flags) {
  Reporter reporter(flags.common);
  const ThreadLimit limit(flags.common);
  Stopwatch watch;
  VerifyFindings findings;
  const bool is_set = is_shell_file(flags.file);
  if (is_set) {
    decode_shells(flags, reporter, findings);
  } else {
    if (!flags.volume.path.empty()) {
      throw Error(
          ErrorCode::BadArgument,
          fmt::format("{}: found no extras.nacre, expected a shell set for --volume", flags.file));
    }
    decode_meshes(flags, reporter, findings);
    reporter.say(
        "no shell set of nacre's: its meshes are checked one by one, equal positions "
        "taken as one vertex; levels, nesting and grid are not known");
  }
  findings.surfaces =
      verify_surfaces(findings.set, {.neighbours = is_set, .progress = reporter.progress()});
  judge_surfaces(findings);
  if (is_set) warn_of_neighbours(findings);
  if (!flags.volume.path.empty()) check_volume(flags, reporter, findings);
  const double seconds = watch.lap();
  say(findings, seconds, reporter);
  ordered_json json = verify_json(findings);
  json["kind"] = is_set ? "shell set" : "glTF meshes";
  json["seconds"] = seconds;
  json["peak_rss_bytes"] = peak_rss_bytes();
  reporter.finish(json);
  return findings.broken.empty() ? 0 : 1;
}

}  // namespace nacre
