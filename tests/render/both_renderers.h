#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <span>
#include <utility>

#include "core/camera.h"
#include "core/image.h"
#include "core/tool.h"
#include "render/cpu/cpu_renderer.h"
#include "render/plan.h"
#include "render/scene_facts.h"
#include "tests/render/cpu_test_support.h"
#include "tests/render/gl_test_support.h"

namespace nacre::testing {

/// A small angiogram, handed over to the processor's renderer and to OpenGL's; skipped without one.
class BothRenderers : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_backend(test_backend())) GTEST_SKIP() << "no OpenGL on this machine";
    gl_.emplace(test_backend());
    gl_->upload(scan_.set);
    cpu_.upload(scan_.set);
  }

  void set_tools(std::span<const Tool> tools) {
    gl_->upload_tools(tools);
    cpu_.upload_tools(tools);
    facts_ = scene_facts(scan_.set, tools);
  }

  /// The picture of one plan by the processor, and by OpenGL.
  std::pair<Picture, Picture> draw_both(const Camera& camera, const RenderOptions& options,
                                        int tile_side) {
    const Plan plan = make_plan(facts_, camera, options, {.max_target_side = tile_side});
    EXPECT_FALSE(cpu_objection(plan));
    return {cpu_.render(camera, plan), gl_->render(camera, plan)};
  }

  const Scan scan_ = small_angiogram();
  SceneFacts facts_;
  CpuRenderer cpu_;
  std::optional<GlRenderer> gl_;
};

}  // namespace nacre::testing
