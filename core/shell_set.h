#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/emission.h"
#include "core/tolerance_weight.h"
#include "core/triangle_mesh.h"
#include "core/volume.h"
#include "core/volume_geometry.h"

namespace nacre {

/// One emission shell: the boundary of { value >= `value` }, closed, counter-clockwise seen from
/// outside.
struct Shell {
  double emission = 0.0;        ///< level t_k, in (0, 1]
  double value = 0.0;           ///< contour value v_k, in the volume's values
  double representative = 0.0;  ///< r_k, the emission shown for the layer above this shell
  TriangleMesh surface;         ///< LPS mm relative to `ShellSet::center_mm`; empty if unreached
  /// The emission that sums add for the layer; none where it is the representative.
  std::optional<double> sum_representative = std::nullopt;
};

/// The emission shown for the layer above a shell where emission is summed along rays.
inline double sum_representative(const Shell& shell) noexcept {
  return shell.sum_representative.value_or(shell.representative);
}

/// Closed components of surfaces, counted.
struct ComponentCount {
  std::size_t components = 0;
  std::size_t triangles = 0;  ///< before simplification
  double volume_mm3 = 0.0;    ///< enclosed, without sign
};

/// What was left out of a set's surfaces on purpose, see `shells/prune.h`.
struct Pruning {
  double min_component_mm3 = 0.0;  ///< components of less volume are specks; 0: none were pruned
  bool inner_pruned = false;       ///< whether components inside their own shell were pruned
  ComponentCount specks;
  ComponentCount inner;
  /// No pixel of a maximum projection of the shells lost more by the specks.
  double largest_emission = 0.0;
};

/// The lattice all positions of a set lie on: origin + step * (i, j, k), 0 <= i, j, k < 2^bits.
/// What it takes for that to be exact in floats: `core/quantization_grid.h`.
struct QuantizationGrid {
  glm::dvec3 origin_mm{0.0};  ///< relative to `ShellSet::center_mm`
  double range_mm = 0.0;      ///< (2^bits - 1) * step
  int bits = 0;               ///< 1 to 23
};

/// What the shells were made from: enough to place them and to recognise the volume, nothing that
/// names a file or a patient.
struct VolumeFacts {
  glm::i64vec3 dims{0};  ///< 0: no volume is stated
  glm::dmat4 world_from_voxel{1.0};
  ScalarType type = ScalarType::U8;
  double slope = 1.0;
  double intercept = 0.0;
  std::uint64_t checksum = 0;  ///< of the stored samples, see docs/shell_file.md
};

inline bool is_stated(const VolumeFacts& volume) noexcept {
  return volume.dims.x > 0 && volume.dims.y > 0 && volume.dims.z > 0;
}

/// A nest of emission shells of one volume, outermost (lowest level) first.
struct ShellSet {
  std::vector<Shell> shells;  ///< levels strictly ascending
  glm::dvec3 center_mm{0.0};  ///< LPS; positions are relative to it, floats fail far from 0
  VolumeFacts volume;
  std::vector<EmissionKnot> emission;  ///< the emission map's knots: the window has two
  std::string placement = "uniform";   ///< "uniform", "optimal" or "explicit"
  double tolerance = 0.0;              ///< allowed emission error of the surfaces; 0 = none made
  ToleranceWeight tolerance_weight = ToleranceWeight::Field;
  std::optional<QuantizationGrid> grid;  ///< none before snapping
  Pruning pruned;
};

}  // namespace nacre
