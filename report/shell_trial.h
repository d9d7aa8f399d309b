#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/emission.h"
#include "core/volume.h"
#include "render/scene_facts.h"
#include "render/shell_renderer.h"
#include "report/measurement.h"

namespace nacre {

/// A shell set as a file in memory, and what making it took.
struct EncodedShells {
  std::vector<std::byte> bytes;
  double seconds = 0.0;
  std::optional<std::size_t> peak_bytes;
};

/// Makes the shells as `nacre build` does.
EncodedShells encode_shells(const Volume& volume, const EmissionMap& emission,
                            const ShellRecipe& recipe);

/// The shells of one recipe in the renderers that draw them: one a backend, shared by its methods.
class ShellTrial {
 public:
  /// Decodes the set once for each backend and hands it over.
  /// @param rows  methods of this recipe; those that cannot be drawn get their `left_out`
  ShellTrial(const EncodedShells& shells, std::span<Measured* const> rows,
             const MeasurementOptions& options);

  /// Methods that can be drawn.
  std::span<Measured* const> rows() const { return drawable_; }

  /// Draws a view.
  /// @param seconds  what `FrameStats` says of it
  Picture draw(const Measured& row, std::size_t view, double& seconds);

  /// Seconds that loading took for the method's backend.
  double load_seconds(const Measured& row) const;

 private:
  struct Loaded {
    std::unique_ptr<ShellRenderer> renderer;
    double seconds = 0.0;
  };

  void plan(Measured& row, const SceneFacts& bare, const SceneFacts& with_tools);
  void open(Measured& row);
  void load(const std::string& backend, const EncodedShells& shells);

  const MeasurementOptions& options_;
  std::vector<Measured*> drawable_;
  std::map<std::string, std::vector<Plan>> plans_;  ///< by method, one a view
  std::map<std::string, Loaded> loaded_;            ///< by backend
  std::map<std::string, std::string> refused_;      ///< backends that do not open, and why
};

}  // namespace nacre
