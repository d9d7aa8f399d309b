#include "render/cpu/cpu_renderer.h"

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/error.h"
#include "render/cpu/detail_levels.h"
#include "render/cpu/large_triangles.h"
#include "render/cpu/max_picture.h"
#include "render/projection.h"
#include "render/ray_frame.h"

namespace nacre {
namespace {

using Clock = std::chrono::steady_clock;

/// Clusters drawn by one task: some microseconds of work.
constexpr std::size_t kTaskClusters = 32;

/// Surfaces of fewer triangles are drawn as they are at all distances.
constexpr std::size_t kLeastTriangles = 2000;

/// Some clusters of a draw of the plan.
struct Task {
  const ShellDraw* draw = nullptr;
  const MeshClusters* mesh = nullptr;
  std::size_t first = 0;
  std::size_t count = 0;
};

glm::dvec4 row(const glm::dmat4& matrix, int r) {
  return {matrix[0][r], matrix[1][r], matrix[2][r], matrix[3][r]};
}

ClusterProjection projection_of(const Camera& camera, const glm::dvec3& center_mm,
                                const PixelRect& tile) {
  const glm::dmat4 clip = clip_from_local(camera, center_mm, tile);
  ClusterProjection projection;
  projection.row_x = row(clip, 0);
  projection.row_y = row(clip, 1);
  projection.row_w = row(clip, 3);
  projection.perspective = camera.perspective;
  projection.row_z = glm::dvec4(0.0, 0.0, 0.0, 0.5) - 0.5 * row(clip, 2);
  const double z_at_eye = z_at_view_depth(camera, 0.0);
  projection.z_of_w = {z_at_eye, z_at_view_depth(camera, 1.0) - z_at_eye};
  projection.near_mm = static_cast<float>(near_plane_mm(camera));
  projection.view_from = camera.perspective ? eye_mm(camera) - center_mm : camera.forward;
  return projection;
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

/// What a draw of the plan shines with.
template <class Pixel>
Brightness<Pixel> brightness_of(const ShellDraw& draw, const Plan& plan) {
  if constexpr (std::is_same_v<Pixel, float>) {
    return {static_cast<float>(draw.value_at_near), static_cast<float>(draw.value_at_far)};
  } else {
    const auto ranks = static_cast<double>(plan.emission_of_rank.size() - 1);
    return {static_cast<Pixel>(std::lround(draw.depth_at_near * ranks))};
  }
}

/// What of a draw this renderer does not do; empty if it does all.
std::string_view objection_to(const ShellDraw& draw) {
  if (draw.tools != ToolCut::None) return "it draws no tools";
  return draw.cut_by_slab ? "it draws whole volumes, no slabs" : "";
}

}  // namespace

std::optional<std::string> cpu_objection(const Plan& plan) {
  for (const Pass& pass : plan.passes) {
    if (pass.kind == PassKind::ToolLayer) return "it draws no tools";
    if (pass.kind != PassKind::MaxDepth) {
      return fmt::format("it draws maximum projections of whole shells, not '{}'", describe(pass));
    }
    for (const ShellDraw& draw : pass.draws) {
      if (const std::string_view found = objection_to(draw); !found.empty()) {
        return std::string(found);
      }
    }
  }
  const std::size_t most = std::numeric_limits<std::uint16_t>::max();
  if (plan.emission_of_rank.size() <= most + 1) return std::nullopt;
  return fmt::format("found {} different shells, expected {} at most",
                     plan.emission_of_rank.size() - 1, most);
}

class CpuRenderer::Drawing {
 public:
  explicit Drawing(const CpuOptions& options) : options_(options) {
    capabilities_.max_target_side = kMaxKernelTarget;
  }

  void upload(const ShellSet& set, const SceneFacts& facts, std::span<const std::uint32_t> shells) {
    check_upload(set, facts, shells);
    shells_.assign(set.shells.size(), {});
    tbb::parallel_for(std::size_t{0}, shells.size(), [&](std::size_t i) {
      const bool all = options_.detail_px <= 0.0;
      shells_[shells[i]] =
          detail_levels(set.shells[shells[i]].surface,
                        all ? std::numeric_limits<std::size_t>::max() : kLeastTriangles);
    });
    scene_ = facts;
    scene_.tools.clear();
  }

  Picture render(const Camera& camera, const Plan& plan) {
    check(plan);
    Picture picture{make_image(camera.size.x, camera.size.y), std::nullopt};
    const Clock::time_point start = Clock::now();
    frame_ = {};
    for (const PixelRect& tile : plan.passes.empty() ? std::vector<PixelRect>{} : plan.tiles) {
      if (plan.depth_scale > 0.0) {
        draw_tile(camera, plan, tile, cued_, picture.volume);
      } else if (plan.emission_of_rank.size() <= std::numeric_limits<std::uint8_t>::max() + 1U) {
        draw_tile(camera, plan, tile, bytes_, picture.volume);
      } else {
        draw_tile(camera, plan, tile, words_, picture.volume);
      }
    }
    frame_.target_bytes = bytes_.bytes() + words_.bytes() + cued_.bytes();
    frame_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return picture;
  }

  const CpuOptions& options() const { return options_; }
  const Capabilities& capabilities() const { return capabilities_; }
  const SceneFacts& scene() const { return scene_; }
  const FrameStats& frame() const { return frame_; }

  std::size_t bytes() const {
    std::size_t sum = 0;
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
      if (shell < shells_.size() && !shells_[shell].empty()) continue;
      throw Error(
          ErrorCode::BadArgument,
          fmt::format("shell {}: found in the plan, expected it uploaded before", shell + 1));
    }
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

  std::vector<Task> tasks_of(const Plan& plan, const Camera& camera) {
    std::vector<Task> tasks;
    for (const Pass& pass : plan.passes) {
      frame_.passes += 1;
      for (const ShellDraw& draw : pass.draws) {
        const MeshClusters& mesh = mesh_for(draw.shell, camera);
        const std::size_t clusters = mesh.clusters.size();
        frame_.draws += 1;
        for (std::size_t first = 0; first < clusters; first += kTaskClusters) {
          tasks.push_back({&draw, &mesh, first, std::min(kTaskClusters, clusters - first)});
        }
      }
    }
    return tasks;
  }

  template <class Pixel>
  void draw_tile(const Camera& camera, const Plan& plan, const PixelRect& tile,
                 MaxPicture<Pixel>& picture, Image& image) {
    const ClusterProjection projection = projection_of(camera, scene_.center_mm, tile);
    const std::vector<Task> tasks = tasks_of(plan, camera);
    std::atomic<std::size_t> triangles = 0;
    picture.begin({tile.width, tile.height});
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tasks.size()), [&](const auto& range) {
      const PixelTarget<Pixel> target = picture.target();
      std::size_t drawn = 0;
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const Brightness<Pixel> brightness = brightness_of<Pixel>(*tasks[i].draw, plan);
        drawn += draw_task(tasks[i], brightness, projection, target);
      }
      triangles += drawn;
    });
    frame_.triangles += triangles;
    picture.resolve(plan.emission_of_rank, tile, image);
  }

  template <class Pixel>
  std::size_t draw_task(const Task& task, const Brightness<Pixel>& brightness,
                        const ClusterProjection& projection,
                        const PixelTarget<Pixel>& target) const {
    const MeshClusters& mesh = *task.mesh;
    ClusterDraw<Pixel> draw{mesh.clusters.data() + task.first,
                            task.count,
                            mesh.positions.data(),
                            mesh.corners.data(),
                            task.draw->faces,
                            brightness};
    std::array<std::uint32_t, kTaskClusters> too_large;
    const KernelResult result =
        draw_clusters_for<Pixel>(options_.instructions)(draw, projection, target, too_large.data());
    for (std::size_t i = 0; i < result.too_large; ++i) {
      draw.clusters = mesh.clusters.data() + task.first + too_large[i];
      draw_large_cluster(draw, projection, target);
    }
    return result.triangles;
  }

  CpuOptions options_;
  Capabilities capabilities_;
  SceneFacts scene_;
  std::vector<std::vector<DetailLevel>> shells_;  // one a shell of the set; empty: not uploaded
  MaxPicture<std::uint8_t> bytes_;
  MaxPicture<std::uint16_t> words_;
  MaxPicture<float> cued_;
  FrameStats frame_;
};

CpuRenderer::CpuRenderer(const CpuOptions& options)
    : drawing_(std::make_unique<Drawing>(options)) {}
CpuRenderer::~CpuRenderer() = default;
CpuRenderer::CpuRenderer(CpuRenderer&&) noexcept = default;
CpuRenderer& CpuRenderer::operator=(CpuRenderer&&) noexcept = default;

std::string_view CpuRenderer::backend_name() const noexcept { return "cpu"; }

std::string CpuRenderer::device_name() const {
  return fmt::format("{} instructions, {} threads",
                     drawing_->options().instructions == InstructionSet::Avx2 ? "AVX2" : "baseline",
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

void CpuRenderer::upload_tools(std::span<const Tool> tools) {
  if (!tools.empty()) throw Error(ErrorCode::Unsupported, "backend cpu: it draws no tools");
}

std::size_t CpuRenderer::uploaded_bytes() const noexcept { return drawing_->bytes(); }

Picture CpuRenderer::render(const Camera& camera, const RenderOptions& options) {
  return render(camera, make_plan(drawing_->scene(), camera, options, capabilities()));
}

Picture CpuRenderer::render(const Camera& camera, const Plan& plan) {
  return drawing_->render(camera, plan);
}

const FrameStats& CpuRenderer::last_frame() const noexcept { return drawing_->frame(); }

}  // namespace nacre
