#include "render/cpu/cpu_renderer.h"

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "render/cpu/large_triangles.h"
#include "render/cpu/rank_picture.h"
#include "render/projection.h"

namespace nacre {
namespace {

using Clock = std::chrono::steady_clock;

/// Clusters drawn by one task: some microseconds of work.
constexpr std::size_t kTaskClusters = 32;

/// Some clusters of a draw of the plan.
struct Task {
  const ShellDraw* draw = nullptr;
  std::size_t first = 0;
  std::size_t count = 0;
};

glm::vec4 row(const glm::dmat4& matrix, int r) {
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
  projection.near_mm = static_cast<float>(near_plane_mm(camera));
  projection.view_from = camera.perspective ? eye_mm(camera) - center_mm : camera.forward;
  return projection;
}

void check_shells(const ShellSet& set, const SceneFacts& facts,
                  std::span<const std::uint32_t> shells) {
  for (const std::uint32_t shell : shells) {
    if (shell >= set.shells.size() || shell >= facts.shells.size()) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("shell {}: found {} in the set", shell + 1, set.shells.size()));
    }
    const std::size_t found = set.shells[shell].surface.triangles.size();
    if (found != facts.shells[shell].triangles) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("shell {}: found {} triangles, expected {}", shell + 1, found,
                              facts.shells[shell].triangles));
    }
  }
}

}  // namespace

class CpuRenderer::Drawing {
 public:
  explicit Drawing(const CpuOptions& options) : options_(options) {
    capabilities_.max_target_side = kMaxKernelTarget;
  }

  void upload(const ShellSet& set, const SceneFacts& facts, std::span<const std::uint32_t> shells) {
    check_shells(set, facts, shells);
    shells_.assign(set.shells.size(), std::nullopt);
    tbb::parallel_for(std::size_t{0}, shells.size(), [&](std::size_t i) {
      shells_[shells[i]] = cluster_mesh(set.shells[shells[i]].surface);
    });
    scene_ = facts;
  }

  Image render(const Camera& camera, const Plan& plan) {
    check(plan);
    Image image = make_image(camera.size.x, camera.size.y);
    const Clock::time_point start = Clock::now();
    frame_ = {};
    for (const PixelRect& tile : plan.passes.empty() ? std::vector<PixelRect>{} : plan.tiles) {
      if (plan.emission_of_rank.size() <= std::numeric_limits<std::uint8_t>::max() + 1U) {
        draw_tile(camera, plan, tile, bytes_, image);
      } else {
        draw_tile(camera, plan, tile, words_, image);
      }
    }
    frame_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return image;
  }

  const Capabilities& capabilities() const { return capabilities_; }
  const SceneFacts& scene() const { return scene_; }
  const CpuFrameStats& frame() const { return frame_; }

  std::size_t bytes() const {
    return std::accumulate(shells_.begin(), shells_.end(), std::size_t{0},
                           [](std::size_t sum, const std::optional<MeshClusters>& shell) {
                             return sum + (shell ? shell->bytes() : 0);
                           });
  }

 private:
  void check(const Plan& plan) const {
    for (const std::uint32_t shell : shells_drawn(plan)) {
      if (shell < shells_.size() && shells_[shell]) continue;
      throw Error(
          ErrorCode::BadArgument,
          fmt::format("shell {}: found in the plan, expected it uploaded before", shell + 1));
    }
    const std::size_t most = std::numeric_limits<std::uint16_t>::max();
    if (plan.emission_of_rank.size() > most + 1) {
      throw Error(ErrorCode::Unsupported,
                  fmt::format("maximum projection: found {} different shells, expected {} at most",
                              plan.emission_of_rank.size() - 1, most));
    }
  }

  std::vector<Task> tasks_of(const Plan& plan) {
    std::vector<Task> tasks;
    for (const Pass& pass : plan.passes) {
      for (const ShellDraw& draw : pass.draws) {
        const std::size_t clusters = shells_[draw.shell]->clusters.size();
        frame_.clusters += clusters;
        for (std::size_t first = 0; first < clusters; first += kTaskClusters) {
          tasks.push_back({&draw, first, std::min(kTaskClusters, clusters - first)});
        }
      }
    }
    return tasks;
  }

  template <class Rank>
  void draw_tile(const Camera& camera, const Plan& plan, const PixelRect& tile,
                 RankPicture<Rank>& picture, Image& image) {
    const ClusterProjection projection = projection_of(camera, scene_.center_mm, tile);
    const std::vector<Task> tasks = tasks_of(plan);
    const double ranks = static_cast<double>(plan.emission_of_rank.size() - 1);
    std::atomic<std::size_t> triangles = 0;
    picture.begin({tile.width, tile.height});
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tasks.size()), [&](const auto& range) {
      const RankTarget<Rank> target = picture.target();
      std::size_t drawn = 0;
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const auto rank = static_cast<Rank>(std::lround(tasks[i].draw->depth_at_near * ranks));
        drawn += draw_task(tasks[i], rank, projection, target);
      }
      triangles += drawn;
    });
    frame_.triangles += triangles;
    picture.resolve(plan.emission_of_rank, tile, image);
  }

  template <class Rank>
  std::size_t draw_task(const Task& task, Rank rank, const ClusterProjection& projection,
                        const RankTarget<Rank>& target) const {
    const MeshClusters& mesh = *shells_[task.draw->shell];
    ClusterDraw<Rank> draw{mesh.clusters.data() + task.first,
                           task.count,
                           mesh.positions.data(),
                           mesh.corners.data(),
                           task.draw->faces,
                           rank};
    std::array<std::uint32_t, kTaskClusters> too_large;
    const KernelResult result =
        draw_clusters_for<Rank>(options_.instructions)(draw, projection, target, too_large.data());
    for (std::size_t i = 0; i < result.too_large; ++i) {
      draw.clusters = mesh.clusters.data() + task.first + too_large[i];
      draw_large_cluster(draw, projection, target);
    }
    return result.triangles;
  }

  CpuOptions options_;
  Capabilities capabilities_;
  SceneFacts scene_;
  std::vector<std::optional<MeshClusters>> shells_;  // one a shell of the set
  RankPicture<std::uint8_t> bytes_;
  RankPicture<std::uint16_t> words_;
  CpuFrameStats frame_;
};

CpuRenderer::CpuRenderer(const CpuOptions& options)
    : drawing_(std::make_unique<Drawing>(options)) {}
CpuRenderer::~CpuRenderer() = default;
CpuRenderer::CpuRenderer(CpuRenderer&&) noexcept = default;
CpuRenderer& CpuRenderer::operator=(CpuRenderer&&) noexcept = default;

const Capabilities& CpuRenderer::capabilities() const noexcept { return drawing_->capabilities(); }

void CpuRenderer::upload(const ShellSet& set) {
  std::vector<std::uint32_t> all(set.shells.size());
  std::iota(all.begin(), all.end(), 0U);
  drawing_->upload(set, scene_facts(set), all);
}

void CpuRenderer::upload(const ShellSet& set, const SceneFacts& facts,
                         std::span<const std::uint32_t> shells) {
  drawing_->upload(set, facts, shells);
}

std::size_t CpuRenderer::uploaded_bytes() const noexcept { return drawing_->bytes(); }

Image CpuRenderer::render(const Camera& camera, const RenderOptions& options) {
  return render(camera, make_plan(drawing_->scene(), camera, options, capabilities()));
}

Image CpuRenderer::render(const Camera& camera, const Plan& plan) {
  return drawing_->render(camera, plan);
}

const CpuFrameStats& CpuRenderer::last_frame() const noexcept { return drawing_->frame(); }

}  // namespace nacre
