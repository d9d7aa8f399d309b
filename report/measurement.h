#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/emission.h"
#include "core/image.h"
#include "core/picture.h"
#include "core/progress.h"
#include "core/tool.h"
#include "core/volume.h"
#include "report/method.h"
#include "report/peer_renderer.h"
#include "report/picture_error.h"
#include "report/spread.h"

namespace nacre {

/// What is measured, and for how long.
struct MeasurementOptions {
  std::vector<Method> methods;
  std::vector<Camera> cameras;     ///< the views; at least one
  Slab slab = {};                  ///< of all pictures
  DepthCue cue = {0.8, 0.2, 0.0};  ///< of the cued ones
  std::span<const Tool> tools = {};
  PeerRenderer* peers = nullptr;  ///< draws the methods with a `peer`; null: they are left out
  double read_seconds = 0.0;      ///< that reading the volume took
  std::size_t input_bytes = 0;    ///< of the volume's file
  int most_passes = 3;            ///< over all methods
  double budget_seconds = 600.0;  ///< no pass is begun that would end later
};

/// What one method bought, at which price.
struct Measured {
  Method method;
  std::string left_out;  ///< why there are no figures; empty if there are
  std::string device;    ///< what drew
  /// Shells: extraction to file bytes; the walk: its bricks; samples: the walk, and what is bright
  /// of its bricks; peers: unknown, never measured.
  Spread build_seconds;
  /// Shells: bytes to a renderer ready to draw; the walk, samples: reading the file; peers:
  /// unknown.
  Spread load_seconds;
  Spread frame_seconds;
  std::size_t bytes = 0;  ///< of the shell set's file, or the volume's
  std::size_t triangles = 0;
  std::optional<std::size_t> build_peak_bytes;  ///< see `MemoryWatch`; volume included
  std::optional<std::size_t> draw_peak_bytes;   ///< loading and first picture
  PictureComparison error;                      ///< over the pixels of all views
  Picture first_view;                           ///< the picture of the first camera
};

/// A subject's exact pictures.
struct Truth {
  Subject subject;
  Picture first_view;
  double peak = 1.0;  ///< 1 for max and iso, else the largest pixel of all views
};

struct MeasurementResult {
  std::vector<Measured> rows;  ///< one a method, in their order
  std::vector<Truth> truths;
  int passes = 0;
  double seconds = 0.0;
};

/// Measures methods on the same views of a volume, in alternation.
///
/// A pass goes through all shell recipes: each is built and encoded, decoded and handed to one
/// renderer a backend; then, view by view, each method draws one frame in turn, the exact walks,
/// the samples and the peers of the same subjects among them. Passes are repeated, so that what the
/// machine does beside it reaches all methods alike. Each renderer draws one picture before frames
/// are timed.
///
/// The error is that of the first pass' pictures against the exact ones (`exact_picture`): pictures
/// do not depend on the pass. What draws the volume otherwise, samples and peers, has drawn each
/// view once before frames are timed, for its error. A method that its backend refuses, or whose
/// backend does not open here, is left out, with the refusal.
///
/// @throws Error  as `build_shells`, `exact_picture` and `encode_shell_set` do
MeasurementResult measure(const Volume& volume, const EmissionMap& emission,
                          const MeasurementOptions& options, const ProgressCallback& progress = {});

}  // namespace nacre
