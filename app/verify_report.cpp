// What `nacre verify` found, as a table and as JSON.
#include "app/verify_report.h"

#include <fmt/core.h>

#include <cmath>

#include "core/quantization_grid.h"

namespace nacre {
namespace {

using nlohmann::ordered_json;

/// Whether there is such a surface: a row for each shell, but only for the copies that there are.
bool is_shown(const SurfaceFindings& findings, std::size_t k) {
  return findings.kind == "shell" || !findings.set.shells[k].surface.triangles.empty();
}

/// The name of a row.
std::string row_name(const SurfaceFindings& findings, std::size_t k) {
  return findings.kind == "shell" ? findings.names[k]
                                  : fmt::format("{} {}", findings.kind, findings.names[k]);
}

std::string yes_no(bool yes) { return yes ? "yes" : "NO"; }

std::string gap(const ShellVerdict& verdict) {
  return verdict.next && std::isfinite(verdict.next->gap_mm)
             ? fmt::format("{:.4g}", verdict.next->gap_mm)
             : "-";
}

std::string surface_line(const SurfaceFindings& findings, std::size_t k) {
  const ShellVerdict& verdict = findings.surfaces[k];
  const ShellReport& topology = verdict.topology;
  const bool oriented =
      topology.misoriented_edges == 0 && (topology.triangles == 0 || topology.volume_mm3 > 0.0);
  return fmt::format(
      "{:<10.10} {:>9} {:>6} {:>6} {:>8} {:>8} {:>6} {:>8} {:>7} {:>8} {:>8} {:>10}",
      row_name(findings, k), topology.triangles, topology.components,
      yes_no(topology.open_edges == 0), yes_no(oriented), yes_no(topology.is_manifold()),
      topology.degenerate, findings.set.grid ? std::to_string(verdict.off_grid) : "-",
      verdict.self_intersections,
      verdict.next ? std::to_string(verdict.next->intersections.crossing) : "-",
      verdict.next ? std::to_string(verdict.next->intersections.touching) : "-", gap(verdict));
}

std::string bounded(const BoundedDistance& distance) {
  return fmt::format("{:.4f}..{:.4f}", distance.lower_mm, distance.upper_mm);
}

std::string volume_line(const SurfaceFindings& findings, std::size_t k) {
  const VolumeVerdict& verdict = findings.against_volume[k];
  const SurfaceEmission& emission = verdict.emission;
  const bool empty = findings.set.shells[k].surface.triangles.empty();
  return fmt::format(
      "{:<10.10} {:>8.5f} {:>9} {:>9.5f} {:>9.5f} {:>9.5f} {:>9.5f} {:>16} {:>16} {:>10}",
      row_name(findings, k), findings.set.shells[k].emission,
      empty ? "-" : fmt::format("{:.4f}..{:.4f}", emission.lo, emission.hi), emission.max_error,
      emission.rms_error, emission.error_bound(findings.set.shells[k].emission),
      verdict.extraction_error_bound, bounded(verdict.to_unsimplified),
      bounded(verdict.from_unsimplified),
      !findings.surfaces[k].next            ? "-"
      : crossing_is_impossible(findings, k) ? "impossible"
                                            : "possible");
}

/// JSON knows no infinity.
ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json();
}

ordered_json surface_json(const SurfaceFindings& findings, std::size_t k) {
  const ShellVerdict& verdict = findings.surfaces[k];
  const ShellReport& topology = verdict.topology;
  ordered_json json;
  json["name"] = findings.names[k];
  json["triangles"] = topology.triangles;
  json["vertices"] = topology.vertices;
  json["components"] = topology.components;
  json["euler"] = topology.euler;
  json["area_mm2"] = topology.area_mm2;
  json["volume_mm3"] = topology.volume_mm3;
  json["open_edges"] = topology.open_edges;
  json["misoriented_edges"] = topology.misoriented_edges;
  json["crowded_edges"] = topology.crowded_edges;
  json["crowded_vertices"] = topology.crowded_vertices;
  json["coincident_vertices"] = topology.coincident_vertices;
  json["degenerate"] = topology.degenerate;
  if (findings.set.grid) json["off_grid"] = verdict.off_grid;
  json["self_intersections"] = verdict.self_intersections;
  if (!verdict.next) return json;
  json["next"] = {{"shell", findings.names[verdict.next->inner]},
                  {"crossing", verdict.next->intersections.crossing},
                  {"touching", verdict.next->intersections.touching},
                  {"gap_mm", number(verdict.next->gap_mm)}};
  if (!findings.against_volume.empty()) {
    json["next"]["crossing_impossible"] = crossing_is_impossible(findings, k);
  }
  return json;
}

ordered_json volume_json(const SurfaceFindings& findings, std::size_t k) {
  const VolumeVerdict& verdict = findings.against_volume[k];
  const SurfaceEmission& emission = verdict.emission;
  const double level = findings.set.shells[k].emission;
  ordered_json json;
  json["level"] = level;
  if (emission.lo <= emission.hi) json["emission_bounds"] = {emission.lo, emission.hi};
  json["max_error"] = emission.max_error;
  json["rms_error"] = emission.rms_error;
  json["error_bound"] = emission.error_bound(level);
  json["beyond_tolerance"] = emission.beyond_tolerance;
  json["extraction_error_bound"] = verdict.extraction_error_bound;
  json["tolerance_kept"] = verdict.tolerance_kept;
  json["hausdorff_to_unsimplified_mm"] = {number(verdict.to_unsimplified.lower_mm),
                                          number(verdict.to_unsimplified.upper_mm)};
  json["hausdorff_from_unsimplified_mm"] = {number(verdict.from_unsimplified.lower_mm),
                                            number(verdict.from_unsimplified.upper_mm)};
  return json;
}

ordered_json shells_json(const SurfaceFindings& findings) {
  ordered_json shells = ordered_json::array();
  for (std::size_t k = 0; k < findings.surfaces.size(); ++k) {
    if (!is_shown(findings, k)) continue;
    ordered_json shell = surface_json(findings, k);
    if (!findings.against_volume.empty()) shell["volume"] = volume_json(findings, k);
    shells.push_back(std::move(shell));
  }
  return shells;
}

/// @param line  of one shell
template <class Line>
void add_lines(const SurfaceFindings& findings, Line&& line, std::vector<std::string>& lines) {
  for (std::size_t k = 0; k < findings.surfaces.size(); ++k) {
    if (is_shown(findings, k)) lines.push_back(line(findings, k));
  }
}

}  // namespace

bool crossing_is_impossible(const SurfaceFindings& findings, std::size_t shell) {
  const auto& next = findings.surfaces[shell].next;
  if (!next || findings.against_volume.empty()) return false;
  return findings.against_volume[shell].emission.hi <
         findings.against_volume[next->inner].emission.lo;
}

std::vector<std::string> verify_table(const VerifyFindings& findings) {
  std::vector<std::string> lines;
  lines.push_back(
      fmt::format("{:<10} {:>9} {:>6} {:>6} {:>8} {:>8} {:>6} {:>8} {:>7} {:>8} {:>8} {:>10}",
                  "shell", "triangles", "parts", "closed", "oriented", "manifold", "degen.",
                  "off grid", "selfint", "crossing", "touching", "gap mm"));
  add_lines(findings, surface_line, lines);
  if (findings.copies) add_lines(*findings.copies, surface_line, lines);
  if (findings.against_volume.empty()) return lines;
  lines.push_back(fmt::format("{:<10} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9} {:>16} {:>16} {:>10}",
                              "shell", "level", "emission of surface", "max error", "RMS", "bound",
                              "anew", "to anew, mm", "from anew, mm", "crossing"));
  add_lines(findings, volume_line, lines);
  if (findings.copies) add_lines(*findings.copies, volume_line, lines);
  return lines;
}

ordered_json verify_json(const VerifyFindings& findings) {
  ordered_json json;
  json["kept"] = findings.broken.empty();
  json["broken"] = findings.broken;
  json["warnings"] = findings.warnings;
  if (findings.set.grid) json["grid_step_mm"] = step_mm(*findings.set.grid);
  json["tolerance"] = findings.set.tolerance;
  json["shells"] = shells_json(findings);
  if (findings.copies) {
    json["copies"] = {{"tolerance", findings.copies->set.tolerance},
                      {"shells", shells_json(*findings.copies)}};
  }
  return json;
}

}  // namespace nacre
