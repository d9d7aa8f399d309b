#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/picture.h"
#include "extract/levels.h"
#include "render/render_options.h"

namespace nacre {

/// Levels of a shell set: a count of uniform ones, or a single one.
struct LevelChoice {
  std::size_t uniform = 0;  ///< 0: the single level
  double single = 0.5;      ///< emission

  auto operator<=>(const LevelChoice&) const = default;
};

/// The levels themselves.
std::vector<Level> levels_of(const LevelChoice& choice);

/// As `--levels` has it: "24", "0.5".
std::string text_of(const LevelChoice& choice);

/// Which shells are made of the volume.
struct ShellRecipe {
  LevelChoice levels;
  double tolerance = 0.0;     ///< emission; 0: no simplification
  int quantization_bits = 0;  ///< 0: chosen by `choose_grid`

  auto operator<=>(const ShellRecipe&) const = default;
};

/// How another program, VTK, casts its rays.
struct PeerRecipe {
  std::string caster = "fixed";  ///< "fixed": on the processor; "gpu": by OpenGL
  double step = 0.5;             ///< between samples, in mean spacings of the volume

  auto operator<=>(const PeerRecipe&) const = default;
};

/// What a picture shows: methods of the same subject are compared with the same truth.
struct Subject {
  PictureMode mode = PictureMode::Max;
  LevelChoice levels = {};  ///< of count and iso; the same for all in max and sum
  bool cued = false;
  bool with_tool = false;

  auto operator<=>(const Subject&) const = default;
};

/// One way to a picture: a row of the report.
struct Method {
  std::string id;    ///< "max-24-cpu", unique
  std::string part;  ///< of the report, one of `report_parts`
  Subject subject = {};
  std::optional<ShellRecipe> shells = {};
  std::optional<PeerRecipe> peer = {};
  std::optional<int> samples = {};  ///< a voxel, of a `SampledMaximum`; none of the three: exact
  std::string backend = "exact";    ///< "cpu", "osmesa", "egl"; "vtk-fixed", "vtk-gpu"; "sampled"
  DepthFormat depth = DepthFormat::D32F;
  TargetFormat target = TargetFormat::F32;
  Occlusion occlusion = Occlusion::Auto;
};

/// Whether the exact walk of the volume draws it.
bool is_exact(const Method& method);

/// Whether it draws the volume itself with an error: by samples, here or in a peer.
bool is_sampled(const Method& method);

/// A part of the report: methods that differ in one thing.
struct ReportPart {
  std::string_view name;   ///< as `--only` has it
  std::string_view title;  ///< for the page
  std::string_view what;   ///< one sentence for a reader who does not know the program
};

/// All parts, in the order of the page.
std::span<const ReportPart> report_parts();

/// Which methods are wanted.
struct MethodChoice {
  bool quick = false;                      ///< fewer level counts, tolerances, quantisations
  bool with_peers = false;                 ///< VTK's ray casters too
  std::span<const std::string> only = {};  ///< names of parts; empty: all
};

/// What is measured: for each part the exact walk first, then what else draws the volume (samples
/// along its rays, then peers), then shells through each backend.
///
/// @throws Error BadArgument for a part that does not exist
std::vector<Method> report_methods(const MethodChoice& choice);

}  // namespace nacre
