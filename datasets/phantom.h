#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "core/progress.h"
#include "core/volume.h"

namespace nacre {

/// What can be wished of a phantom.
struct PhantomOptions {
  /// Samples along x, y, z; default: the phantom's own. The field keeps its place in the world:
  /// more samples resolve the same anatomy, or the same equation, more finely.
  std::optional<glm::i64vec3> size = std::nullopt;

  /// Of everything random in the phantom: the angiogram's vessels, the cell's corners, all noise.
  std::uint64_t seed = 1;

  /// Standard deviation of the noise, in the volume's values, not negative; default: the phantom's
  /// own. Gaussian, added; in the angiogram Rician, as a scanner's magnitude pictures have it.
  std::optional<double> noise = std::nullopt;

  /// `cell` only: the values at its corners, x fastest; finite. Default: random in [-1, 1).
  std::optional<std::array<double, 8>> corners = std::nullopt;
};

/// A phantom's card.
struct PhantomInfo {
  std::string_view name;      ///< "angiogram"
  std::string_view what;      ///< one line for `phantom --list`
  glm::i64vec3 default_size;  ///< samples along x, y, z
  ScalarType type;            ///< of the stored samples
  double default_noise;       ///< standard deviation, in the volume's values
  double window_lo;           ///< a window that shows it, in the volume's values
  double window_hi;
};

/// All phantoms, in the order in which they are listed.
std::span<const PhantomInfo> phantom_list();

/// Makes a phantom: a volume from an equation or a seeded model, centred on the world's origin,
/// its axes along LPS.
///
/// The same name and options give the same bytes on every machine, with any number of threads.
/// Equations: `datasets/closed_forms.h` (spheres, torus, quadratic, cell, checkerboard),
/// `datasets/angiogram.h`, `datasets/scalar_fields.h` (hipip, plume).
///
/// @param name     one of phantom_list()
/// @param progress told about the stage "phantom"
/// @throws Error   BadArgument for an unknown name, a dimension below 1, a negative or infinite
///                 noise, corners that are not finite, and for a size other than 2 x 2 x 2 or
///                 corners where they do not apply
/// @throws std::bad_alloc  where there is not enough memory
Volume make_phantom(std::string_view name, const PhantomOptions& options = {},
                    const ProgressCallback& progress = {});

}  // namespace nacre
