#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/camera.h"
#include "core/emission.h"
#include "core/picture.h"
#include "core/volume.h"
#include "reference/cue_field.h"
#include "reference/grid_walk.h"
#include "reference/volume_bricks.h"

namespace nacre {

/// World to cell coordinates about the volume's centre, so that a far-away origin costs no digits.
struct CellFrame {
  glm::dmat3 world_from_cell;  ///< its linear part
  glm::dmat3 cell_from_world;
  glm::dvec3 center_mm;
  glm::dvec3 center_cell;

  CellFrame(const Volume& volume, const glm::i64vec3& cells);

  CellLine line(const Ray& ray) const;
};

/// The cue along a line: beta(t), linear in t and never negative.
struct LineCue {
  double at_enter = 1.0;     ///< at t = 0
  double rise_per_mm = 0.0;  ///< along the line

  double operator()(double t) const { return std::max(0.0, at_enter + rise_per_mm * t); }
};

/// The same line and cue, seen from t = `end`: the way back.
inline CellLine reversed(const CellLine& line, double end) {
  return {line.origin + end * line.direction, -line.direction};
}
inline LineCue reversed(const LineCue& beta, double end) { return {beta(end), -beta.rise_per_mm}; }

/// A ray's part inside the volume's box, counted from where it begins there: t starts at 0 whatever
/// the distance of the eye.
struct EnteredLine {
  CellLine line;
  LineInterval interval;  ///< t_enter is 0
  double t_begin_mm;      ///< where that is on the ray
};

/// The same, with the border faces it passes through.
struct BoxPassage : EnteredLine {
  std::optional<int> entry_axis;  ///< none where the ray begins inside
  std::optional<int> exit_axis;   ///< none where it is cut off inside
};

/// The value that the field must exceed for its emission to exceed `needed`: never above the true
/// one, so that nothing is skipped for rounding.
double least_field_above(const EmissionMap& map, double needed);

/// A volume prepared for rays: what all walks of it share.
///
/// The walks work in "field" units, factor * stored: rising with the value also where the slope is
/// negative, and within the doubles also for samples near their limit.
struct WalkField {
  WalkField(const Volume& volume, const EmissionMap& map);

  /// The interval of the ray inside the box; nothing where it misses it.
  std::optional<EnteredLine> enter(const Ray& ray, const RayInterval& wanted) const;

  /// The same, knowing faces. A ray that begins in a border face passes through it.
  std::optional<BoxPassage> pass_through(const Ray& ray, const RayInterval& wanted) const;

  /// The cue along an entered line. By positions about the volume's centre, so that it loses no
  /// digits to a far eye.
  LineCue along(const CueField& cue, const Ray& ray, const EnteredLine& entered) const;

  double value_of(double field) const { return slope * (field / factor) + intercept; }
  double field_of(double value) const { return (value - intercept) / slope * factor; }

  const Volume* volume;
  glm::i64vec3 cells;
  VolumeBricks bricks;  ///< in field units
  CellFrame frame;
  double slope;
  double intercept;
  double factor;
  EmissionMap emission_of_field;
  std::vector<double> brightest;  ///< T of each brick's greatest value
  double brightest_of_all = 0.0;
  std::array<std::int64_t, 8> corner_offset;  ///< samples from a cell's first corner to each
};

}  // namespace nacre
