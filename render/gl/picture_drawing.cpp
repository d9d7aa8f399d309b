#include "render/gl/picture_drawing.h"

#include <GL/glcorearb.h>

#include <algorithm>

#include "render/ray_ends.h"
#include "render/tiles.h"

namespace nacre {
namespace {

/// Turns depths d = rank / n, in place, into the emission each rank stands for.
void look_up(std::span<float> depths, const std::vector<float>& emission_of_rank) {
  const auto ranks = static_cast<float>(emission_of_rank.size() - 1);
  const float half = 0.5F;  // to the nearest; std::lround is a call a pixel
  for (float& depth : depths) {
    depth = emission_of_rank[static_cast<std::size_t>(depth * ranks + half)];
  }
}

void scale(std::span<float> depths, double factor) {
  const auto by = static_cast<float>(factor);
  for (float& depth : depths) depth *= by;
}

ColorFormat color_format(TargetFormat format) {
  switch (format) {
    case TargetFormat::U8: return ColorFormat::R8;
    case TargetFormat::F16: return ColorFormat::R16F;
    case TargetFormat::F32: break;
  }
  return ColorFormat::R32F;
}

/// The depths a pass draws, from the start of the rays, with a margin: depths at the very ends
/// would be lost to the cleared buffer, and a flat tool has one depth only.
Interval test_depths(const Pass& pass, const RaySpan& rays) {
  const double margin = 1e-3 + 1e-3 * (pass.depths_mm.hi - pass.depths_mm.lo);
  return {pass.depths_mm.lo - rays.start_mm - margin, pass.depths_mm.hi - rays.start_mm + margin};
}

/// Part of a tile's pixels.
template <class Element>
std::span<const Element> row_of(const std::vector<Element>& pixels, int row, int width) {
  if (pixels.empty()) return {};
  const auto length = static_cast<std::size_t>(width);
  return std::span(pixels).subspan(static_cast<std::size_t>(row) * length, length);
}

/// Where the rays of a row of pixels end: by the slab or, if there are any, by tools.
std::vector<float> ends_of(std::span<const glm::vec4> tools, const RayFrame& rays, int width) {
  std::vector<float> ends_mm(static_cast<std::size_t>(width), finite_mm(rays.end_mm));
  for (std::size_t i = 0; i < tools.size(); ++i) ends_mm[i] = std::min(ends_mm[i], tools[i].w);
  return ends_mm;
}

/// @param samples  a pixel along each axis; what the middle one shows is the pixel's
void copy_tools(std::span<const glm::vec4> layer, const PixelRect& rect, int samples,
                ToolLayer& tools) {
  std::size_t from = 0;
  for (int y = 0; y < rect.height; ++y) {
    for (int x = 0; x < rect.width; ++x, ++from) {
      if (layer[from].w == no_tool_mm()) continue;
      const std::optional<glm::ivec2> pixel = pixel_of({rect.x + x, rect.y + y}, samples);
      if (!pixel) continue;
      const std::size_t to =
          static_cast<std::size_t>(pixel->y) * static_cast<std::size_t>(tools.width) +
          static_cast<std::size_t>(pixel->x);
      tools.colors[to] = glm::vec3(layer[from]);
      tools.covered[to] = 1;
    }
  }
}

}  // namespace

PictureDrawing::PictureDrawing(const GlFunctions& gl)
    : gl_(&gl), max_pass_(gl), crossings_pass_(gl), lit_pass_(gl), tool_pass_(gl) {}

Picture PictureDrawing::draw(const Camera& shown, const Plan& plan, const SceneBuffers& scene,
                             PictureMemory& memory) {
  const Camera camera = with_samples(shown, plan.samples);
  Picture picture{blank_samples(shown, plan, memory), std::nullopt};
  stats_ = {};
  if (plan.passes.empty()) return picture;
  // The first tile is the largest; the others use a part of its targets.
  largest_tile_ = {plan.tiles.front().width, plan.tiles.front().height};
  if (plan.passes.front().kind == PassKind::ToolLayer) {
    picture.tools = make_tool_layer(shown.size.x, shown.size.y);
  }
  for (const PixelRect& rect : plan.tiles) draw_tile(camera, plan, scene, rect, picture);
  check_gl(*gl_, "drawing");
  drop_unseen_tools(picture);
  return picture;
}

void PictureDrawing::draw_tile(const Camera& camera, const Plan& plan, const SceneBuffers& scene,
                               const PixelRect& rect, Picture& picture) {
  Tile tile{.rect = rect};
  tile.frame.clip_from_local = glm::mat4(clip_from_local(camera, scene.center_mm, rect));
  tile.frame.rays = ray_frame(camera, scene.center_mm, plan.rays, plan.cue, rect);
  tile.frame.perspective = camera.perspective;
  for (const Pass& pass : plan.passes) {
    run(plan, pass, scene, tile, picture.volume);
    count(pass);
  }
  if (picture.tools) copy_tools(tile.tools, rect, plan.samples, *picture.tools);
  for (const Pass& pass : plan.passes) {
    const bool at_end = pass.kind == PassKind::EndCounts;
    if (!at_end && pass.kind != PassKind::StartCounts) continue;
    const std::vector<float>& counts = at_end ? tile.end_counts : tile.start_counts;
    for (int y = 0; y < rect.height; ++y) {
      const std::span<float> row(&picture.volume.at(rect.x, rect.y + y),
                                 static_cast<std::size_t>(rect.width));
      raise_to_ray_ends(row_of(counts, y, rect.width), pass.emission_of_count,
                        ends_of(row_of(tile.tools, y, rect.width), tile.frame.rays, rect.width),
                        tile.frame.rays, at_end, row);
    }
  }
}

void PictureDrawing::run(const Plan& plan, const Pass& pass, const SceneBuffers& scene, Tile& tile,
                         Image& volume) {
  switch (pass.kind) {
    case PassKind::ToolLayer: draw_tools(plan, pass, *scene.tools, tile); break;
    case PassKind::MaxDepth:
    case PassKind::MaxColor: draw_max(plan, pass, scene, tile, volume); break;
    case PassKind::StartCounts: draw_counts(pass, *scene.shells, tile, tile.start_counts); break;
    case PassKind::EndCounts: draw_counts(pass, *scene.shells, tile, tile.end_counts); break;
    case PassKind::Sum:
    case PassKind::Count:
    case PassKind::Lit: draw_colors(plan, pass, *scene.shells, tile, volume); break;
  }
}

void PictureDrawing::draw_tools(const Plan& plan, const Pass& pass, const ToolBuffers& tools,
                                Tile& tile) {
  const RenderTarget& target = begin(tool_target_, {ColorFormat::Rgba32F, DepthFormat::D32F},
                                     tile.rect, 1.0F, {0.0F, 0.0F, 0.0F, no_tool_mm()});
  tool_pass_.draw(pass, test_depths(pass, plan.rays), tools, tile.frame);
  tile.frame.tool_layer = target.texture();
  const glm::ivec2 size(tile.rect.width, tile.rect.height);
  tile.tools.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  target.read_rgba(size, tile.tools.data());
}

void PictureDrawing::draw_counts(const Pass& pass, const ShellBuffers& shells, const Tile& tile,
                                 std::vector<float>& counts) {
  const RenderTarget& target =
      begin(count_target_, {.color = ColorFormat::R32F}, tile.rect, 0.0F, {});
  crossings_pass_.draw(pass, shells, tile.frame);
  const glm::ivec2 size(tile.rect.width, tile.rect.height);
  counts.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  target.read_red(size, counts.data(), size.x);
}

void PictureDrawing::draw_max(const Plan& plan, const Pass& pass, const SceneBuffers& scene,
                              const Tile& tile, Image& volume) {
  const bool color = pass.kind == PassKind::MaxColor;
  TargetLayout layout{.depth = plan.depth};
  if (color) layout.color = ColorFormat::R32F;
  const RenderTarget& target = begin(volume_target_, layout, tile.rect, 0.0F, {});
  max_pass_.draw(pass, *scene.shells, scene.tools, tile.frame);
  const PixelRect& rect = tile.rect;
  const glm::ivec2 size(rect.width, rect.height);
  if (color) {
    target.read_red(size, &volume.at(rect.x, rect.y), volume.width);
    return;
  }
  target.read_depth(size, &volume.at(rect.x, rect.y), volume.width);
  for (int y = 0; y < rect.height; ++y) {
    const std::span<float> row(&volume.at(rect.x, rect.y + y),
                               static_cast<std::size_t>(rect.width));
    plan.depth_scale > 0.0 ? scale(row, plan.depth_scale) : look_up(row, plan.emission_of_rank);
  }
}

void PictureDrawing::draw_colors(const Plan& plan, const Pass& pass, const ShellBuffers& shells,
                                 const Tile& tile, Image& volume) {
  const bool lit = pass.kind == PassKind::Lit;
  TargetLayout layout{.color = color_format(plan.target)};
  if (lit) layout.depth = plan.depth;
  const RenderTarget& target = begin(volume_target_, layout, tile.rect, 1.0F, {});
  if (lit) {
    lit_pass_.draw(pass, test_depths(pass, plan.rays), shells, tile.frame);
  } else {
    crossings_pass_.draw(pass, shells, tile.frame);
  }
  target.read_red({tile.rect.width, tile.rect.height}, &volume.at(tile.rect.x, tile.rect.y),
                  volume.width);
}

const RenderTarget& PictureDrawing::begin(std::optional<RenderTarget>& target,
                                          const TargetLayout& layout, const PixelRect& rect,
                                          float depth, const glm::vec4& color) {
  if (!target || target->size() != largest_tile_ || target->layout() != layout) {
    target.reset();
    target.emplace(*gl_, largest_tile_, layout);
  }
  target->begin({rect.width, rect.height}, depth, color);
  if (rect.x == 0 && rect.y == 0) stats_.target_bytes += target->bytes();
  return *target;
}

void PictureDrawing::count(const Pass& pass) {
  stats_.passes += 1;
  stats_.draws += pass.kind == PassKind::ToolLayer ? pass.tools.size() : pass.draws.size();
  for (const ShellDraw& draw : pass.draws) {
    if (draw.tools == ToolCut::Passes) stats_.draws += pass.tools.size();
  }
  stats_.triangles += triangles(pass);
}

}  // namespace nacre
