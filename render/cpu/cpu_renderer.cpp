#include "render/cpu/cpu_renderer.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/volume_border.h"
#include "render/cpu/detail_levels.h"
#include "render/cpu/plan_drawing.h"
#include "render/cpu/tool_meshes.h"
#include "render/projection.h"

namespace nacre {
namespace {

using Clock = std::chrono::steady_clock;

/// Surfaces of fewer triangles are drawn as they are at all distances.
constexpr std::size_t kLeastTriangles = 2000;

/// Of the scene's diagonal, what a cluster may span: 115 pixels where the whole of it is drawn with
/// 1536.
constexpr double kClusterPart = 0.075;

/// Of the box around all shells.
double diagonal_mm(const SceneFacts& facts) {
  Box all{glm::dvec3(std::numeric_limits<double>::infinity()),
          glm::dvec3(-std::numeric_limits<double>::infinity())};
  for (const ShellFacts& shell : facts.shells) {
    if (shell.triangles == 0) continue;
    all.lo = glm::min(all.lo, shell.bounds.lo);
    all.hi = glm::max(all.hi, shell.bounds.hi);
  }
  return glm::distance(all.lo, all.hi);
}

/// Length of a millimetre in the picture where the box is nearest to the eye.
double most_pixels_per_mm(const Camera& camera, const glm::dvec3& center_mm, const Box& box) {
  const double pixels = 0.5 * std::min(camera.size.x, camera.size.y) / camera.half_extent;
  if (!camera.perspective) return pixels;
  const glm::dvec3 middle = 0.5 * (box.lo + box.hi) + center_mm;
  const glm::dvec3 reach = 0.5 * (box.hi - box.lo) * glm::abs(camera.forward);
  const double nearest =
      glm::dot(camera.forward, middle - eye_mm(camera)) - (reach.x + reach.y + reach.z);
  // Off the middle of the picture what moves along the ray moves sideways too; a half extent of 1
  // is a picture of 90 degrees.
  return pixels / std::max(nearest, near_plane_mm(camera)) * (1.0 + camera.half_extent);
}

std::string_view name(InstructionSet set) {
  if (set == InstructionSet::Avx512) return "AVX-512";
  return set == InstructionSet::Avx2 ? "AVX2" : "baseline";
}

/// Whether the pass is part of what this renderer draws.
bool draws(const Pass& pass) {
  return pass.kind == PassKind::ToolLayer || pass.kind == PassKind::MaxDepth ||
         pass.kind == PassKind::StartCounts || pass.kind == PassKind::EndCounts ||
         pass.kind == PassKind::Sum || pass.kind == PassKind::Count;
}

}  // namespace

std::optional<std::string> cpu_objection(const Plan& plan) {
  for (const Pass& pass : plan.passes) {
    if (!draws(pass)) {
      return fmt::format(
          "it draws maximum projections, sums and counts, tools by texture, not '{}'",
          describe(pass));
    }
    const bool adds_up = pass.kind == PassKind::Sum || pass.kind == PassKind::Count;
    if (adds_up && plan.target != TargetFormat::F32) {
      return fmt::format(
          "it adds up in whole numbers, read as floats: found target {}, expected 32f",
          name(plan.target));
    }
  }
  const std::size_t most = std::numeric_limits<std::uint16_t>::max();
  if (plan.emission_of_rank.size() <= most + 1) return std::nullopt;
  return fmt::format("found {} different shells, expected {} at most",
                     plan.emission_of_rank.size() - 1, most);
}

class CpuRenderer::Drawing {
 public:
  explicit Drawing(const CpuOptions& options) : options_(options), pictures_(options.instructions) {
    capabilities_.max_target_side = kMaxKernelTarget;
  }

  void upload(const ShellSet& set, const SceneFacts& facts, std::span<const std::uint32_t> shells) {
    check_upload(set, facts, shells);
    shells_.assign(set.shells.size(), {});
    const double most_mm = kClusterPart * diagonal_mm(facts);
    tbb::parallel_for(std::size_t{0}, shells.size(), [&](std::size_t i) {
      const bool all = options_.detail_px <= 0.0;
      const TriangleMesh& surface = set.shells[shells[i]].surface;
      const std::optional<TriangleMesh> within = within_border(set, surface);
      shells_[shells[i]] =
          detail_levels(within ? *within : surface,
                        all ? std::numeric_limits<std::size_t>::max() : kLeastTriangles, most_mm);
    });
    scene_ = facts;
    scene_.tools.clear();
    tools_ = {};
  }

  void upload_tools(std::span<const Tool> tools) {
    tools_ = ToolMeshes(tools, scene_.center_mm);
    scene_.tools.clear();
    for (const Tool& tool : tools) scene_.tools.push_back(tool_facts(tool, scene_.center_mm));
  }

  Picture render(const Camera& camera, const Plan& plan) {
    check(plan);
    const Clock::time_point start = Clock::now();
    SceneMeshes scene{scene_.center_mm, {}, &tools_};
    scene.shells.resize(shells_.size());
    for (const std::uint32_t shell : shells_drawn(plan)) {
      scene.shells[shell] = &mesh_for(shell, camera);
    }
    Picture picture = pictures_.draw(camera, plan, scene);
    frame_ = pictures_.stats();
    frame_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return picture;
  }

  const CpuOptions& options() const { return options_; }
  const Capabilities& capabilities() const { return capabilities_; }
  const SceneFacts& scene() const { return scene_; }
  const FrameStats& frame() const { return frame_; }

  std::size_t bytes() const {
    std::size_t sum = tools_.bytes();
    for (const std::vector<DetailLevel>& levels : shells_) {
      for (const DetailLevel& level : levels) sum += level.mesh.bytes();
    }
    return sum;
  }

 private:
  void check(const Plan& plan) const {
    if (const auto objection = cpu_objection(plan)) {
      throw Error(ErrorCode::Unsupported, "backend cpu: " + *objection);
    }
    for (const std::uint32_t shell : shells_drawn(plan)) {
      if (shell >= shells_.size() || shells_[shell].empty()) refuse("shell", shell);
    }
    for (const Pass& pass : plan.passes) {
      for (const std::uint32_t tool : pass.tools) {
        if (!tools_.holds(tool)) refuse("tool", tool);
      }
    }
  }

  [[noreturn]] static void refuse(std::string_view what, std::uint32_t index) {
    throw Error(
        ErrorCode::BadArgument,
        fmt::format("{} {}: found in the plan, expected it uploaded before", what, index + 1));
  }

  /// The coarsest level of detail that is as good as asked for.
  const MeshClusters& mesh_for(std::uint32_t shell, const Camera& camera) const {
    const std::vector<DetailLevel>& levels = shells_[shell];
    const double pixels = most_pixels_per_mm(camera, scene_.center_mm, scene_.shells[shell].bounds);
    std::size_t chosen = 0;
    for (std::size_t i = 1; i < levels.size(); ++i) {
      if (levels[i].error_mm * pixels <= options_.detail_px) chosen = i;
    }
    return levels[chosen].mesh;
  }

  CpuOptions options_;
  Capabilities capabilities_;
  SceneFacts scene_;
  std::vector<std::vector<DetailLevel>> shells_;  // one a shell of the set; empty: not uploaded
  ToolMeshes tools_;
  PlanDrawing pictures_;
  FrameStats frame_;
};

CpuRenderer::CpuRenderer(const CpuOptions& options)
    : drawing_(std::make_unique<Drawing>(options)) {}
CpuRenderer::~CpuRenderer() = default;
CpuRenderer::CpuRenderer(CpuRenderer&&) noexcept = default;
CpuRenderer& CpuRenderer::operator=(CpuRenderer&&) noexcept = default;

std::string_view CpuRenderer::backend_name() const noexcept { return "cpu"; }

std::string CpuRenderer::device_name() const {
  return fmt::format("{} instructions, {} threads", name(drawing_->options().instructions),
                     tbb::this_task_arena::max_concurrency());
}

const Capabilities& CpuRenderer::capabilities() const noexcept { return drawing_->capabilities(); }

void CpuRenderer::upload(const ShellSet& set) {
  std::vector<std::uint32_t> all(set.shells.size());
  std::iota(all.begin(), all.end(), 0U);
  drawing_->upload(set, scene_facts(set), all);
}

void CpuRenderer::upload(const ShellSet& set, const SceneFacts& facts,
                         std::span<const std::uint32_t> shells, const UploadOptions&) {
  drawing_->upload(set, facts, shells);
}

void CpuRenderer::upload_tools(std::span<const Tool> tools) { drawing_->upload_tools(tools); }

std::size_t CpuRenderer::uploaded_bytes() const noexcept { return drawing_->bytes(); }

Picture CpuRenderer::render(const Camera& camera, const RenderOptions& options) {
  return render(camera, make_plan(drawing_->scene(), camera, options, capabilities()));
}

Picture CpuRenderer::render(const Camera& camera, const Plan& plan) {
  return drawing_->render(camera, plan);
}

const FrameStats& CpuRenderer::last_frame() const noexcept { return drawing_->frame(); }

}  // namespace nacre
