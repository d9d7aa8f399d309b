#include "app/exact_scene.h"

#include <fmt/core.h>

#include "core/error.h"

namespace nacre {

ExactScene::ExactScene(const ExactFlags& flags)
    : level_flags_(flags.levels),
      ideal_(flags.ideal),
      samples_(flags.samples),
      tools_(std::make_unique<const ToolRays>(read_tools(flags.scene))) {
  options_.mode = picture_mode(flags.picture);
  options_.cue = depth_cue(flags.scene);
  options_.slab = slab(flags.camera);
  options_.tools = tools_.get();
  if (samples_ > 0 && options_.mode != PictureMode::Max) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("--method sampled: found --mode {}, expected max", flags.picture.mode));
  }
}

bool ExactScene::shows_shells() const {
  return ideal_ || options_.mode == PictureMode::Count || options_.mode == PictureMode::Iso;
}

void ExactScene::set_emission(const EmissionMap& emission) {
  if (!shows_shells()) return;
  if (level_flags_.placement == "optimal") {
    throw Error(ErrorCode::Unsupported,
                "--placement: found optimal, expected uniform or a list of levels for an exact "
                "picture (nacre build prints the levels it finds)");
  }
  levels_ = levels_of(level_flags_, emission, options_.mode == PictureMode::Iso ? "0.5" : "24");
  for (const Level& level : levels_) {
    options_.levels.push_back({emission.value_at(level.emission), level.representative});
  }
}

void ExactScene::prepare(const ExactWalk& walk) {
  if (samples_ > 0) sampled_ = std::make_unique<const SampledMaximum>(walk);
}

bool ExactScene::takes_samples(const Camera& camera) const {
  return sampled_ && sampled_->takes_samples(camera, options_.cue);
}

Picture ExactScene::draw(const ExactWalk& walk, const Camera& camera,
                         const ProgressCallback& progress) const {
  if (sampled_) {
    return sampled_->picture(
        camera,
        {.per_cell = samples_, .cue = options_.cue, .slab = options_.slab, .tools = options_.tools},
        progress);
  }
  return ideal_ ? ideal_picture(walk, camera, options_, progress)
                : exact_picture(walk, camera, options_, progress);
}

nlohmann::ordered_json ExactScene::level_figures() const {
  auto figures = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    figures.push_back({{"emission", levels_[i].emission},
                       {"value", options_.levels[i].value},
                       {"representative", levels_[i].representative}});
  }
  return figures;
}

}  // namespace nacre
