#include "render/cpu/plan_drawing.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <type_traits>

#include "render/cpu/large_triangles.h"
#include "render/cpu/sum_steps.h"
#include "render/cpu/thread_pixels.h"
#include "render/cpu/tile_ends.h"
#include "render/projection.h"
#include "render/ray_ends.h"
#include "render/ray_frame.h"
#include "render/tiles.h"

namespace nacre {
namespace {

/// Clusters drawn by one task: some microseconds of work.
constexpr std::size_t kTaskClusters = 32;

glm::dvec4 row(const glm::dmat4& matrix, int r) {
  return {matrix[0][r], matrix[1][r], matrix[2][r], matrix[3][r]};
}

ClusterProjection projection_of(const Camera& camera, const RayFrame& rays, double start_mm,
                                const glm::dvec3& center_mm, const PixelRect& tile) {
  const glm::dmat4 clip = clip_from_local(camera, center_mm, tile);
  ClusterProjection projection;
  projection.row_x = row(clip, 0);
  projection.row_y = row(clip, 1);
  projection.row_w = row(clip, 3);
  projection.perspective = camera.perspective;
  projection.row_depth = rays.depth_from_local;
  projection.start_mm = camera.perspective ? static_cast<float>(start_mm) : 0.0F;
  const double z_at_eye = z_at_view_depth(camera, 0.0);
  projection.z_of_depth = camera.perspective
                              ? glm::dvec2(z_at_eye, z_at_view_depth(camera, 1.0) - z_at_eye)
                              : rays.z_of_depth;
  projection.near_mm = static_cast<float>(near_plane_mm(camera));
  projection.view_from = camera.perspective ? eye_mm(camera) - center_mm : camera.forward;
  return projection;
}

/// What a shell of a cued maximum shines with.
Brightness<float> emission_of(const ShellDraw& draw) {
  return {static_cast<float>(draw.value_at_near), static_cast<float>(draw.value_at_far)};
}

/// Its rank in a maximum without a cue.
template <class Pixel>
auto rank_of(const Plan& plan) {
  const auto ranks = static_cast<double>(plan.emission_of_rank.size() - 1);
  return [ranks](const ShellDraw& draw) {
    return Brightness<Pixel>{static_cast<Pixel>(std::lround(draw.depth_at_near * ranks))};
  };
}

bool is_cut(const ShellDraw& draw) { return draw.cut_by_slab || draw.tools != ToolCut::None; }

/// Whether some rays of the plan have ends that matter.
bool needs_ends(const Plan& plan) {
  return std::any_of(plan.passes.begin(), plan.passes.end(), [](const Pass& pass) {
    return pass.kind == PassKind::ToolLayer || pass.kind == PassKind::StartCounts ||
           pass.kind == PassKind::EndCounts ||
           std::any_of(pass.draws.begin(), pass.draws.end(), is_cut);
  });
}

/// Parts of a mesh, each for one task.
template <class Pixel>
void add_tasks(const MeshClusters& mesh, ClusterDraw<Pixel> draw,
               std::vector<ClusterDraw<Pixel>>& tasks) {
  draw.positions = mesh.positions.data();
  draw.corners = mesh.corners.data();
  for (std::size_t first = 0; first < mesh.clusters.size(); first += kTaskClusters) {
    draw.clusters = mesh.clusters.data() + first;
    draw.count = std::min(kTaskClusters, mesh.clusters.size() - first);
    tasks.push_back(draw);
  }
}

/// Whole shells hide most of what lies around them: what is drawn after them seldom raises a pixel.
std::vector<ShellDraw> brightest_first(std::vector<ShellDraw> draws) {
  std::ranges::stable_sort(draws, std::greater<>{}, &ShellDraw::depth_at_near);
  return draws;
}

/// Tasks in another order: a part of every shell, then the next part of every shell, as many parts
/// as threads. A mesh's clusters follow each other in space, so that a thread, which takes tasks in
/// a row, draws what hides its later ones itself.
template <class Pixel>
std::vector<ClusterDraw<Pixel>> part_by_part(
    const std::vector<std::vector<ClusterDraw<Pixel>>>& tasks_of_shells) {
  const auto parts = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  std::vector<ClusterDraw<Pixel>> tasks;
  for (std::size_t part = 0; part < parts; ++part) {
    for (const std::vector<ClusterDraw<Pixel>>& shell : tasks_of_shells) {
      for (std::size_t i = shell.size() * part / parts; i < shell.size() * (part + 1) / parts;
           ++i) {
        tasks.push_back(shell[i]);
      }
    }
  }
  return tasks;
}

/// Part of a picture, and how it is seen.
struct Tile {
  PixelRect rect;
  RayFrame rays;
  ClusterProjection projection;
};

Tile tile_of(const Camera& camera, const Plan& plan, const SceneMeshes& scene,
             const PixelRect& rect) {
  const Camera sampling = with_samples(camera, plan.samples);
  Tile tile{rect, ray_frame(sampling, scene.center_mm, plan.rays, plan.cue, rect), {}};
  tile.projection = projection_of(sampling, tile.rays, plan.rays.start_mm, scene.center_mm, rect);
  return tile;
}

/// Whether the picture is estimated from ranks that one pass draws.
bool draws_layers_alone(const Plan& plan) {
  return !plan.layers.empty() && plan.passes.size() == 1 && plan.tiles.size() == 1;
}

void in_parallel(int count, const std::function<void(int)>& row) {
  tbb::parallel_for(0, count, row);
}

}  // namespace

class PlanDrawing::Targets {
 public:
  explicit Targets(InstructionSet instructions) : instructions_(instructions) {}

  Picture draw(const Camera& camera, const Plan& plan, const SceneMeshes& scene) {
    stats_ = {};
    Picture picture;
    if (draws_layers_alone(plan)) {
      draw_layers(plan, scene, tile_of(camera, plan, scene, plan.tiles.front()), picture.volume);
    } else {
      picture.volume = blank_samples(camera, plan, memory_);
      draw_tiles(camera, plan, scene, picture);
      finish_picture(plan, picture, memory_, in_parallel);
    }
    stats_.target_bytes = bytes();
    return picture;
  }

  const FrameStats& stats() const { return stats_; }

 private:
  void draw_tiles(const Camera& camera, const Plan& plan, const SceneMeshes& scene,
                  Picture& picture) {
    if (plan.passes.empty()) return;
    if (plan.passes.front().kind == PassKind::ToolLayer) {
      picture.tools = make_tool_layer(camera.size.x, camera.size.y);
    }
    for (const PixelRect& rect : plan.tiles) {
      draw_tile(plan, scene, tile_of(camera, plan, scene, rect), picture);
    }
    drop_unseen_tools(picture);
  }

  void draw_tile(const Plan& plan, const SceneMeshes& scene, const Tile& tile, Picture& picture) {
    if (needs_ends(plan)) ends_.begin({tile.rect.width, tile.rect.height}, tile.rays);
    for (const Pass& pass : plan.passes) {
      stats_.passes += 1;
      stats_.draws += pass.kind == PassKind::ToolLayer ? pass.tools.size() : pass.draws.size();
      switch (pass.kind) {
        case PassKind::ToolLayer: draw_tools(plan, pass, scene, tile, *picture.tools); break;
        case PassKind::StartCounts:
        case PassKind::EndCounts: draw_counts(pass, scene, tile, picture.volume); break;
        case PassKind::Sum:
        case PassKind::Count: draw_sums(pass, scene, tile, picture.volume); break;
        default: draw_max(plan, pass, scene, tile, picture.volume);
      }
    }
  }

  void draw_tools(const Plan& plan, const Pass& pass, const SceneMeshes& scene, const Tile& tile,
                  ToolLayer& layer) {
    std::vector<ClusterDraw<std::uint64_t>> tasks;
    for (const std::uint32_t tool : pass.tools) {
      add_tasks<std::uint64_t>(
          scene.tools->mesh(tool),
          {.faces = Faces::Both, .brightness = {scene.tools->first_triangle(tool)}}, tasks);
    }
    run(tasks, tile, nearest_);
    nearest_.merge([&](int y, std::span<const std::uint64_t> seen) {
      for (std::size_t x = 0; x < seen.size(); ++x) {
        if (seen[x] == 0) continue;
        const NearestKey nearest = nearest_of(seen[x]);
        const int column = static_cast<int>(x);
        ends_.lower(column, y, nearest.depth_mm);
        const auto shown = pixel_of({tile.rect.x + column, tile.rect.y + y}, plan.samples);
        if (!shown) continue;
        const std::size_t to =
            static_cast<std::size_t>(shown->y) * static_cast<std::size_t>(layer.width) +
            static_cast<std::size_t>(shown->x);
        layer.colors[to] = scene.tools->color_at(nearest, {column + 0.5, y + 0.5}, tile.rays);
        layer.covered[to] = 1;
      }
    });
    ends_.find_range();
  }

  /// A maximum whose ranks are its layers: estimated from them as they are.
  void draw_layers(const Plan& plan, const SceneMeshes& scene, const Tile& tile, Image& image) {
    const Pass& pass = plan.passes.front();
    if (needs_ends(plan)) ends_.begin({tile.rect.width, tile.rect.height}, tile.rays);
    stats_.passes += 1;
    stats_.draws += pass.draws.size();
    if (plan.emission_of_rank.size() <= std::numeric_limits<std::uint8_t>::max() + 1U) {
      draw_shells(pass, scene, tile, rank_of<std::uint8_t>(plan), bytes_);
      estimate_between_layers<std::uint8_t>(plan, tile, bytes_, image);
    } else {
      draw_shells(pass, scene, tile, rank_of<std::uint16_t>(plan), words_);
      estimate_between_layers<std::uint16_t>(plan, tile, words_, image);
    }
  }

  template <class Rank>
  static void estimate_between_layers(const Plan& plan, const Tile& tile, ThreadPixels<Rank>& drawn,
                                      Image& image) {
    const std::span<Rank> ranks = drawn.merged();
    black_outside(plan.columns, tile.rect.width, ranks);
    const LayerSamples<Rank> samples{tile.rect.width / plan.samples,
                                     tile.rect.height / plan.samples, plan.samples, ranks};
    dequantize(samples, plan.layers, {}, in_parallel, image);
    black_outside(middle_spans(plan.columns, plan.samples), image);
  }

  void draw_max(const Plan& plan, const Pass& pass, const SceneMeshes& scene, const Tile& tile,
                Image& image) {
    const auto show_ranks = [&](int y, auto ranks) {
      float* out = &image.at(tile.rect.x, tile.rect.y + y);
      for (std::size_t x = 0; x < ranks.size(); ++x) out[x] = plan.emission_of_rank[ranks[x]];
    };
    if (plan.depth_scale > 0.0) {
      draw_shells(pass, scene, tile, emission_of, cued_);
      cued_.merge([&](int y, std::span<const float> emissions) {
        std::copy(emissions.begin(), emissions.end(), &image.at(tile.rect.x, tile.rect.y + y));
      });
    } else if (plan.emission_of_rank.size() <= std::numeric_limits<std::uint8_t>::max() + 1U) {
      draw_shells(pass, scene, tile, rank_of<std::uint8_t>(plan), bytes_);
      bytes_.merge(show_ranks);
    } else {
      draw_shells(pass, scene, tile, rank_of<std::uint16_t>(plan), words_);
      words_.merge(show_ranks);
    }
  }

  void draw_counts(const Pass& pass, const SceneMeshes& scene, const Tile& tile, Image& image) {
    const bool at_end = pass.kind == PassKind::EndCounts;
    const auto number = [](const ShellDraw&) { return Brightness<std::int32_t>{}; };
    draw_shells(pass, scene, tile, number, counts_);
    counts_.merge([&](int y, std::span<const std::int32_t> counted) {
      const std::vector<float> counts(counted.begin(), counted.end());
      raise_to_ray_ends(counts, pass.emission_of_count, ends_.row(y), tile.rays, at_end,
                        {&image.at(tile.rect.x, tile.rect.y + y), counted.size()});
    });
  }

  void draw_sums(const Pass& pass, const SceneMeshes& scene, const Tile& tile, Image& image) {
    const SumSteps steps(pass, scene, tile.rays);
    draw_shells(
        pass, scene, tile, [&](const ShellDraw& draw) { return steps.of(draw); }, sums_);
    sums_.merge([&](int y, std::span<const std::int64_t> sums) {
      float* out = &image.at(tile.rect.x, tile.rect.y + y);
      for (std::size_t x = 0; x < sums.size(); ++x) {
        const glm::dvec2 pixel(static_cast<double>(x) + 0.5, y + 0.5);
        const double way = steps.is_integral() ? glm::length(local_way(tile.rays, pixel)) : 1.0;
        out[x] = static_cast<float>(static_cast<double>(sums[x]) * steps.step() * way);
      }
    });
  }

  /// @param brightness  of a `ShellDraw`
  template <class Pixel, class BrightnessOf>
  void draw_shells(const Pass& pass, const SceneMeshes& scene, const Tile& tile,
                   const BrightnessOf& brightness, ThreadPixels<Pixel>& target) {
    const bool at_start = pass.kind == PassKind::StartCounts;
    const RayEnds ends = at_start ? ends_.starts() : ends_.ends();
    std::vector<std::vector<ClusterDraw<Pixel>>> tasks;
    for (const ShellDraw& draw : brightest_first(pass.draws)) {
      const bool cut = kCounts<Pixel> || is_cut(draw);
      add_tasks<Pixel>(
          *scene.shells[draw.shell],
          {.faces = draw.faces, .brightness = brightness(draw), .ends = cut ? &ends : nullptr},
          tasks.emplace_back());
    }
    run(part_by_part(tasks), tile, target);
  }

  template <class Pixel>
  void run(const std::vector<ClusterDraw<Pixel>>& tasks, const Tile& tile,
           ThreadPixels<Pixel>& pixels) {
    std::atomic<std::size_t> triangles = 0;
    pixels.begin({tile.rect.width, tile.rect.height});
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tasks.size()), [&](const auto& range) {
      const PixelTarget<Pixel> target = pixels.target();
      std::size_t drawn = 0;
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        drawn += draw_clusters(tasks[i], tile.projection, target);
      }
      triangles += drawn;
    });
    stats_.triangles += triangles;
  }

  template <class Pixel>
  std::size_t draw_clusters(const ClusterDraw<Pixel>& task, const ClusterProjection& projection,
                            const PixelTarget<Pixel>& target) const {
    std::array<std::uint32_t, kTaskClusters> too_large;
    const KernelResult result =
        draw_clusters_for<Pixel>(instructions_)(task, projection, target, too_large.data());
    ClusterDraw<Pixel> large = task;
    for (std::size_t i = 0; i < result.too_large; ++i) {
      large.clusters = task.clusters + too_large[i];
      draw_large_cluster(large, projection, target);
    }
    return result.triangles;
  }

  std::size_t bytes() const {
    return bytes_.bytes() + words_.bytes() + cued_.bytes() + counts_.bytes() + sums_.bytes() +
           nearest_.bytes() + ends_.bytes();
  }

  InstructionSet instructions_;
  ThreadPixels<std::uint8_t> bytes_;
  ThreadPixels<std::uint16_t> words_;
  ThreadPixels<float> cued_;
  ThreadPixels<std::int32_t> counts_;
  ThreadPixels<std::int64_t> sums_;
  ThreadPixels<std::uint64_t> nearest_;
  TileEnds ends_;
  PictureMemory memory_;
  FrameStats stats_;
};

PlanDrawing::PlanDrawing(InstructionSet instructions)
    : targets_(std::make_unique<Targets>(instructions)) {}
PlanDrawing::~PlanDrawing() = default;
PlanDrawing::PlanDrawing(PlanDrawing&&) noexcept = default;
PlanDrawing& PlanDrawing::operator=(PlanDrawing&&) noexcept = default;

Picture PlanDrawing::draw(const Camera& camera, const Plan& plan, const SceneMeshes& scene) {
  return targets_->draw(camera, plan, scene);
}

const FrameStats& PlanDrawing::stats() const noexcept { return targets_->stats(); }

}  // namespace nacre
