#include "shells/surface_emission.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "shells/field_bounds.h"

namespace nacre {
namespace {

constexpr double kSampleSpacing = 0.5;  // voxels
constexpr int kMostCuts = 256;        // of a side: a triangle across the volume is sampled coarser
constexpr std::size_t kBlock = 2048;  // triangles; sums are taken block by block, in order

/// Sums over a part of a surface.
struct Sums {
  SurfaceEmission extremes;
  double area = 0.0;
  double beyond_area = 0.0;
  double squared_error = 0.0;  ///< times area

  void add(const Sums& other) {
    extremes.lo = std::min(extremes.lo, other.extremes.lo);
    extremes.hi = std::max(extremes.hi, other.extremes.hi);
    extremes.max_error = std::max(extremes.max_error, other.extremes.max_error);
    extremes.max_error_less_snapping =
        std::max(extremes.max_error_less_snapping, other.extremes.max_error_less_snapping);
    area += other.area;
    beyond_area += other.beyond_area;
    squared_error += other.squared_error;
  }
};

struct Triangle {
  std::array<glm::dvec3, 3> mm;
  std::array<glm::dvec3, 3> voxel;
};

class Measurement {
 public:
  Measurement(const TrilinearField& field, const EmissionMap& emission, double level,
              double tolerance, double step_mm)
      : field_(field),
        emission_(emission),
        level_(level),
        border_(border_voxels(field, step_mm)),
        tolerance_(tolerance),
        step_mm_(step_mm) {}

  void bound(const Triangle& t, Sums& sums) const {
    if (is_cap(field_, t.mm[0], t.mm[1], t.mm[2], border_)) return;
    const ValueBounds values = value_bounds(field_, t.voxel[0], t.voxel[1], t.voxel[2]);
    sums.extremes.lo = std::min(sums.extremes.lo, emission_(values.lo));
    sums.extremes.hi = std::max(sums.extremes.hi, emission_(values.hi));
  }

  void sample(const Triangle& t, Sums& sums) const {
    for (const glm::dvec3& corner : t.mm) take(corner, 0.0, sums);
    const int cuts = cuts_of(t);
    const glm::dvec3 u = (t.mm[1] - t.mm[0]) / static_cast<double>(cuts);
    const glm::dvec3 v = (t.mm[2] - t.mm[0]) / static_cast<double>(cuts);
    const double area = 0.5 * glm::length(glm::cross(u, v));
    for (int i = 0; i < cuts; ++i) {
      for (int j = 0; i + j < cuts; ++j) {
        const glm::dvec3 corner = t.mm[0] + static_cast<double>(i) * u + static_cast<double>(j) * v;
        take(corner + (u + v) / 3.0, area, sums);
        if (i + j + 1 < cuts) take(corner + (u + v) * (2.0 / 3.0), area, sums);
      }
    }
  }

 private:
  static int cuts_of(const Triangle& t) {
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      longest = std::max(longest, glm::distance(t.voxel[i], t.voxel[(i + 1) % 3]));
    }
    return std::clamp(static_cast<int>(std::ceil(longest / kSampleSpacing)), 1, kMostCuts);
  }

  /// One sample, which stands for a part of the area.
  void take(const glm::dvec3& p, double area, Sums& sums) const {
    const double error = level_error(p);
    sums.area += area;
    sums.squared_error += area * error * error;
    if (error > tolerance_) sums.beyond_area += area;
    SurfaceEmission& most = sums.extremes;
    most.max_error = std::max(most.max_error, error);
    if (error > most.max_error_less_snapping) {
      most.max_error_less_snapping = std::max(most.max_error_less_snapping, error - by_snapping(p));
    }
  }

  /// As `LevelError`, but with a border as wide as snapping moves positions.
  double level_error(const glm::dvec3& p_mm) const {
    const glm::dvec3 p = field_.voxel_from_local(p_mm);
    const double error = emission_(field_.value(p)) - level_;
    if (error <= 0.0) return -error;
    const VoxelBox& box = field_.box();
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] <= box.lo[axis] + border_ || p[axis] >= box.hi[axis] - border_) return 0.0;
    }
    return error;
  }

  /// How much a step along each axis can change the error here.
  double by_snapping(const glm::dvec3& p) const {
    if (step_mm_ == 0.0) return 0.0;
    double change = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 step(0.0);
      step[axis] = step_mm_;
      const double here = phi(p);
      change += std::max(std::abs(phi(p + step) - here), std::abs(phi(p - step) - here));
    }
    return change;
  }

  double phi(const glm::dvec3& p_mm) const {
    return emission_(field_.value(field_.voxel_from_local(p_mm)));
  }

  const TrilinearField& field_;
  const EmissionMap& emission_;
  double level_;
  double border_;
  double tolerance_;
  double step_mm_;
};

/// Calls `visit(triangle, sums)` with every triangle; sums over blocks, joined in order.
template <class Visit>
Sums over_triangles(const TriangleMesh& mesh, const TrilinearField& field, Visit&& visit) {
  const std::size_t blocks = (mesh.triangles.size() + kBlock - 1) / kBlock;
  std::vector<Sums> parts(blocks);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    const std::size_t end = std::min((block + 1) * kBlock, mesh.triangles.size());
    for (std::size_t i = block * kBlock; i < end; ++i) {
      Triangle triangle;
      for (std::size_t corner = 0; corner < 3; ++corner) {
        triangle.mm[corner] =
            glm::dvec3(mesh.positions[mesh.triangles[i][static_cast<int>(corner)]]);
        triangle.voxel[corner] = field.voxel_from_local(triangle.mm[corner]);
      }
      visit(triangle, parts[block]);
    }
  });
  Sums all;
  for (const Sums& part : parts) all.add(part);
  return all;
}

}  // namespace

double border_voxels(const TrilinearField& field, double step_mm) noexcept {
  const glm::dvec3 origin = field.voxel_from_local(glm::dvec3(0.0));
  double reach = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 half_step(0.0);
    half_step[axis] = 0.5 * step_mm;
    const glm::dvec3 moved = glm::abs(field.voxel_from_local(half_step) - origin);
    reach += std::max({moved.x, moved.y, moved.z});
  }
  return kOnBorderVoxels + reach;
}

bool is_cap(const TrilinearField& field, const glm::dvec3& a_mm, const glm::dvec3& b_mm,
            const glm::dvec3& c_mm, double border) noexcept {
  const glm::dvec3 a = field.voxel_from_local(a_mm);
  const glm::dvec3 b = field.voxel_from_local(b_mm);
  const glm::dvec3 c = field.voxel_from_local(c_mm);
  const glm::dvec3 lo = glm::max(glm::max(a, b), c) - field.box().lo;
  const glm::dvec3 hi = field.box().hi - glm::min(glm::min(a, b), c);
  for (int axis = 0; axis < 3; ++axis) {
    if (lo[axis] <= border || hi[axis] <= border) return true;
  }
  return false;
}

SurfaceEmission measure_surface_emission(const TriangleMesh& mesh, const TrilinearField& field,
                                         const EmissionMap& emission, double level,
                                         double tolerance, double step_mm) {
  const Measurement measurement(field, emission, level, tolerance, step_mm);
  const Sums sums = over_triangles(mesh, field, [&](const Triangle& t, Sums& part) {
    measurement.bound(t, part);
    measurement.sample(t, part);
  });
  SurfaceEmission result = sums.extremes;
  result.area_mm2 = sums.area;
  if (sums.area > 0.0) {
    result.rms_error = std::sqrt(sums.squared_error / sums.area);
    result.beyond_tolerance = sums.beyond_area / sums.area;
  }
  return result;
}

SurfaceEmission bound_surface_emission(const TriangleMesh& mesh, const TrilinearField& field,
                                       const EmissionMap& emission, double step_mm) {
  const Measurement measurement(field, emission, 0.0, 0.0, step_mm);
  return over_triangles(mesh, field,
                        [&](const Triangle& t, Sums& part) { measurement.bound(t, part); })
      .extremes;
}

}  // namespace nacre
