#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/exact_command.h"
#include "casting/sampled_maximum.h"
#include "core/emission.h"
#include "extract/levels.h"
#include "reference/exact_picture.h"

namespace nacre {

/// What an exact picture shows of a volume and beside it, as flags say it.
class ExactScene {
 public:
  /// Reads the tools.
  /// @throws Error  for flags that are wrong, and tools that cannot be read
  explicit ExactScene(const ExactFlags& flags);

  /// Whether shells are shown: count, iso, and ideal shells.
  bool shows_shells() const;

  /// Works the levels out, where shells are shown.
  /// @throws Error  BadArgument for flags that name no levels
  void set_emission(const EmissionMap& emission);

  /// Makes ready what is drawn of a walk beside it.
  /// @param walk  outlives this object
  void prepare(const ExactWalk& walk);

  /// Samples a voxel that a maximum is drawn by; 0: it is exact.
  int samples() const { return samples_; }

  /// Whether a camera's picture is one of samples.
  bool takes_samples(const Camera& camera) const;

  /// What `exact_picture`, `ideal_picture` or a sampled maximum is asked for.
  Picture draw(const ExactWalk& walk, const Camera& camera, const ProgressCallback& progress) const;

  /// The levels shown, for machines: emission, value, representative; none without shells.
  nlohmann::ordered_json level_figures() const;

 private:
  LevelFlags level_flags_;
  bool ideal_ = false;
  int samples_ = 0;
  std::unique_ptr<const SampledMaximum> sampled_;
  std::unique_ptr<const ToolRays> tools_;
  std::vector<Level> levels_;
  ExactPictureOptions options_;
};

}  // namespace nacre
