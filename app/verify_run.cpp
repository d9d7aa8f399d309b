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

/// A surface that cannot be decoded is a broken promise like others: the rest is checked all the
/// same.
void decode_surface(const VerifyFlags& flags, std::size_t k, bool coarse, Reporter& reporter,
                    SurfaceFindings& surfaces, std::vector<std::string>& broken) {
  try {
    ShellSet one = read_shell_set(flags.file, {.wanted = [k](std::size_t i) { return i == k; },
                                               .coarse = coarse,
                                               .progress = reporter.progress()});
    surfaces.set.shells[k].surface = std::move(one.shells[k].surface);
  } catch (const Error& error) {
    broken.emplace_back(error.what());
  }
}

void decode_copies(const VerifyFlags& flags, const ShellFileInfo& info, Reporter& reporter,
                   VerifyFindings& findings) {
  SurfaceFindings& copies = findings.copies.emplace();
  copies.kind = "copy";
  copies.names = findings.names;
  copies.set = info.set;
  copies.set.tolerance = info.coarse->tolerance;
  for (std::size_t k = 0; k < info.levels.size(); ++k) {
    if (!info.coarse->levels[k]) continue;
    decode_surface(flags, k, true, reporter, copies, findings.broken);
  }
}

void decode_shells(const VerifyFlags& flags, Reporter& reporter, VerifyFindings& findings) {
  const ShellFileInfo info = read_shell_file_info(flags.file);
  findings.set = info.set;
  for (std::size_t k = 0; k < info.levels.size(); ++k) {
    findings.names.push_back(fmt::format("{}", k + 1));
    if (info.levels[k].bytes == 0) continue;
    decode_surface(flags, k, false, reporter, findings, findings.broken);
  }
  if (info.coarse) decode_copies(flags, info, reporter, findings);
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

void judge_surfaces(const SurfaceFindings& surfaces, std::vector<std::string>& broken) {
  for (std::size_t k = 0; k < surfaces.surfaces.size(); ++k) {
    for (const std::string& promise : broken_promises(surfaces.surfaces[k])) {
      broken.push_back(fmt::format("{} {}: found {}", surfaces.kind, surfaces.names[k], promise));
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

void check_emission(const Volume& volume, Reporter& reporter, SurfaceFindings& surfaces,
                    std::vector<std::string>& broken) {
  surfaces.against_volume = verify_against_volume(surfaces.set, volume, reporter.progress());
  for (std::size_t k = 0; k < surfaces.against_volume.size(); ++k) {
    const VolumeVerdict& verdict = surfaces.against_volume[k];
    if (verdict.tolerance_kept) continue;
    broken.push_back(
        fmt::format("{} {}: found an emission error of {:.4g} beside what snapping accounts for, "
                    "expected at most the tolerance of {:.4g} or the {:.4g} of contouring",
                    surfaces.kind, surfaces.names[k], verdict.emission.max_error_less_snapping,
                    surfaces.set.tolerance, verdict.extraction_error_bound));
  }
}

void check_volume(const VerifyFlags& flags, Reporter& reporter, VerifyFindings& findings) {
  const Volume volume = volume_for(flags, reporter);
  if (const auto objection = other_volume(findings.set, volume)) {
    findings.broken.push_back(*objection);
    return;  // figures against another volume would say nothing
  }
  check_emission(volume, reporter, findings, findings.broken);
  if (findings.copies) check_emission(volume, reporter, *findings.copies, findings.broken);
}

std::size_t triangle_count(const SurfaceFindings& surfaces) {
  std::size_t triangles = 0;
  for (const ShellVerdict& verdict : surfaces.surfaces) triangles += verdict.topology.triangles;
  return triangles;
}

void say(const VerifyFindings& findings, double seconds, Reporter& reporter) {
  for (const std::string& line : verify_table(findings)) reporter.say(line);
  for (const std::string& warning : findings.warnings) reporter.warn(warning);
  for (const std::string& promise : findings.broken) reporter.warn("broken: " + promise);
  std::string copies;
  if (findings.copies) {
    const auto& shells = findings.copies->set.shells;
    copies = fmt::format(
        ", {} coarse copies, {} triangles",
        std::count_if(shells.begin(), shells.end(),
                      [](const Shell& shell) { return !shell.surface.triangles.empty(); }),
        triangle_count(*findings.copies));
  }
  reporter.say(fmt::format("{} surfaces, {} triangles{}: {} ({:.1f} s)", findings.surfaces.size(),
                           triangle_count(findings), copies,
                           findings.broken.empty()
                               ? "all promises kept"
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
  judge_surfaces(findings, findings.broken);
  if (findings.copies) {
    findings.copies->surfaces = verify_surfaces(
        findings.copies->set, {.neighbours = false, .progress = reporter.progress()});
    judge_surfaces(*findings.copies, findings.broken);
  }
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
