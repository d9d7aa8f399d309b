#include "shells/surface_visibility.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace nacre {
namespace {
double knob(const char* name, double otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atof(text) : otherwise;
}
}  // namespace

BrightestBlocks::BrightestBlocks(const Volume& volume, const EmissionMap& emission)
    : dims_((glm::ivec3(volume.dims) + kSide - 1) / kSide),
      most_(static_cast<std::size_t>(dims_.x) * static_cast<std::size_t>(dims_.y) *
                static_cast<std::size_t>(dims_.z),
            0.0f) {
  visit_samples(volume, [&](auto samples) {
    std::size_t i = 0;
    for (std::int64_t z = 0; z < volume.dims.z; ++z) {
      for (std::int64_t y = 0; y < volume.dims.y; ++y) {
        for (std::int64_t x = 0; x < volume.dims.x; ++x, ++i) {
          const double v = volume.slope * static_cast<double>(samples[i]) + volume.intercept;
          float& most = most_[static_cast<std::size_t>(
              x / kSide + dims_.x * (y / kSide + dims_.y * (z / kSide)))];
          most = std::max(most, static_cast<float>(emission(v)));
        }
      }
    }
  });
}

SurfaceVisibility::SurfaceVisibility(const TriangleMesh& surface, const TrilinearField& field,
                                     const EmissionMap& emission, const BrightestBlocks& blocks,
                                     double hidden_from)
    : field_(field), dims_(blocks.dims()) {
  static const double skip = knob("RD_SKIP", 2.0);
  static const int rays = static_cast<int>(knob("RD_RAYS", 1));
  const std::size_t n = static_cast<std::size_t>(dims_.x) * static_cast<std::size_t>(dims_.y) *
                        static_cast<std::size_t>(dims_.z);
  std::vector<float> seen(n, 0.0f);
  std::vector<float> all(n, 0.0f);
  const glm::dmat3 voxel_from_mm = field.voxel_from_mm();
  const glm::ivec3 size(field.volume().dims);
  const auto hidden_along = [&](const glm::dvec3& start, const glm::dvec3& step) {
    double t = skip;
    for (int guard = 0; guard < 4096; ++guard) {
      const glm::dvec3 p = start + t * step;
      const glm::ivec3 v(glm::floor(p + 0.5));
      if (glm::any(glm::lessThan(v, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(v, size)))
        return false;
      const glm::ivec3 block = v / BrightestBlocks::kSide;
      if (static_cast<double>(blocks.at(block)) < hidden_from) {
        const glm::dvec3 lo = glm::dvec3(block * BrightestBlocks::kSide) - 0.5;
        const glm::dvec3 hi = lo + static_cast<double>(BrightestBlocks::kSide);
        double leave = 1e30;
        for (int a = 0; a < 3; ++a) {
          if (step[a] > 0.0) leave = std::min(leave, (hi[a] - start[a]) / step[a]);
          if (step[a] < 0.0) leave = std::min(leave, (lo[a] - start[a]) / step[a]);
        }
        t = std::max(leave + 1e-6, t + 1e-3);
        continue;
      }
      if (emission(field.value(glm::dvec3(v))) >= hidden_from) return true;
      t += 1.0;
    }
    return false;
  };
  double sum = 0.0;
  double total = 0.0;
  std::size_t index = 0;
  for (const glm::uvec3& t : surface.triangles) {
    const glm::dvec3 a(surface.positions[t.x]);
    const glm::dvec3 b(surface.positions[t.y]);
    const glm::dvec3 c(surface.positions[t.z]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double twice_area = glm::length(normal);
    if (!(twice_area > 0.0)) continue;
    const glm::dvec3 u = glm::normalize(glm::abs(normal.x) > 0.6 * twice_area
                                            ? glm::cross(normal, glm::dvec3(0, 1, 0))
                                            : glm::cross(normal, glm::dvec3(1, 0, 0)));
    const glm::dvec3 w = glm::cross(normal / twice_area, u);
    const glm::dvec3 center = field.voxel_from_local((a + b + c) / 3.0);
    const glm::ivec3 block = glm::clamp(
        glm::ivec3(glm::floor((center + 0.5) / static_cast<double>(BrightestBlocks::kSide))),
        glm::ivec3(0), dims_ - 1);
    const auto cell = static_cast<std::size_t>(block.x + dims_.x * (block.y + dims_.y * block.z));
    for (int r = 0; r < rays; ++r) {
      const double angle = 2.39996322972865332 * static_cast<double>(index++);
      glm::dvec3 direction = voxel_from_mm * (std::cos(angle) * u + std::sin(angle) * w);
      direction = glm::normalize(direction);
      const bool hidden =
          hidden_along(center, direction) || hidden_along(center, -direction);
      const double weight = twice_area;
      all[cell] += static_cast<float>(weight);
      total += weight;
      if (hidden) continue;
      seen[cell] += static_cast<float>(weight);
      sum += weight;
    }
  }
  mean_ = total > 0.0 ? sum / total : 1.0;
  // Smooth over a block's neighbours, so that few rays say enough.
  static const int radius = static_cast<int>(knob("RD_BLUR", 1));
  part_.assign(n, static_cast<float>(mean_));
  for (int z = 0; z < dims_.z; ++z)
    for (int y = 0; y < dims_.y; ++y)
      for (int x = 0; x < dims_.x; ++x) {
        double s = 0.0;
        double m = 0.0;
        for (int k = std::max(z - radius, 0); k <= std::min(z + radius, dims_.z - 1); ++k)
          for (int j = std::max(y - radius, 0); j <= std::min(y + radius, dims_.y - 1); ++j)
            for (int i = std::max(x - radius, 0); i <= std::min(x + radius, dims_.x - 1); ++i) {
              const auto cell = static_cast<std::size_t>(i + dims_.x * (j + dims_.y * k));
              const double near = (i == x ? 2.0 : 1.0) * (j == y ? 2.0 : 1.0) * (k == z ? 2.0 : 1.0);
              s += near * static_cast<double>(seen[cell]);
              m += near * static_cast<double>(all[cell]);
            }
        if (m > 0.0)
          part_[static_cast<std::size_t>(x + dims_.x * (y + dims_.y * z))] =
              static_cast<float>(s / m);
      }
}

double SurfaceVisibility::at(const glm::dvec3& p_mm) const noexcept {
  const glm::dvec3 p = field_.voxel_from_local(p_mm);
  const glm::ivec3 block = glm::clamp(
      glm::ivec3(glm::floor((p + 0.5) / static_cast<double>(BrightestBlocks::kSide))),
      glm::ivec3(0), dims_ - 1);
  return static_cast<double>(
      part_[static_cast<std::size_t>(block.x + dims_.x * (block.y + dims_.y * block.z))]);
}

}  // namespace nacre
