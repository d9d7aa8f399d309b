#include "reference/exact_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/volume_geometry.h"
#include "reference/cubic.h"
#include "reference/grid_walk.h"
#include "reference/mean_emission.h"
#include "reference/trilinear_line.h"
#include "reference/volume_bricks.h"

namespace nacre {
namespace {

/// Beyond this magnitude sums of a few samples may overflow a double; they are scaled down.
constexpr double kLargeSample = 1e300;
constexpr double kScaleDown = 1.0 / 1024.0;

/// The walk works in "field" units, factor * stored: rising with the value also where the slope is
/// negative, and within the doubles also for samples near their limit.
double field_factor(const Volume& volume, const VolumeBricks& bricks) {
  double largest = 0.0;
  for (const double value : bricks.least) largest = std::max(largest, std::abs(value));
  for (const double value : bricks.greatest) largest = std::max(largest, std::abs(value));
  const double sign = volume.slope < 0.0 ? -1.0 : 1.0;
  return largest > kLargeSample ? sign * kScaleDown : sign;
}

/// The map with its knots in field units. Knots a hair apart may fall together in the conversion;
/// they are kept apart by the least step a double can make.
EmissionMap in_field_units(const EmissionMap& map, double slope, double intercept, double factor) {
  std::vector<EmissionKnot> knots(map.knots().begin(), map.knots().end());
  double previous = -std::numeric_limits<double>::infinity();
  for (EmissionKnot& knot : knots) {
    knot.value = (knot.value - intercept) / slope * factor;
    if (!(knot.value > previous)) {
      knot.value = std::nextafter(previous, std::numeric_limits<double>::infinity());
    }
    previous = knot.value;
  }
  return EmissionMap::piecewise_linear(std::move(knots));
}

/// World to cell coordinates about the volume's centre, so that a far-away origin costs no digits.
struct CellFrame {
  glm::dmat3 cell_from_world;
  glm::dvec3 center_mm;
  glm::dvec3 center_cell;

  CellFrame(const Volume& volume, const glm::i64vec3& cells)
      : cell_from_world(glm::inverse(glm::dmat3(volume.world_from_voxel))),
        center_mm(bounding_sphere(volume.dims, volume.world_from_voxel).center_mm),
        center_cell(0.5 * glm::dvec3(cells)) {}

  CellLine line(const Ray& ray) const {
    return {center_cell + cell_from_world * (ray.origin_mm - center_mm),
            cell_from_world * ray.direction};
  }
};

}  // namespace

/// What does not depend on the stored type.
class ExactWalk::Walker {
 public:
  virtual ~Walker() = default;
  /// In field units, from `floor` up; stops at `ceiling`. `floor` where nothing exceeds it.
  virtual double max_field(const CellLine& line, const LineInterval& interval, double floor,
                           double ceiling) const = 0;
  virtual double integral(const CellLine& line, const LineInterval& interval) const = 0;

  /// The interval of the ray inside the box, and the line there, counted from its entry: t starts
  /// near 0 whatever the distance of the eye.
  std::optional<std::pair<CellLine, LineInterval>> enter(const Ray& ray,
                                                         const RayInterval& wanted) const {
    CellLine line = frame.line(ray);
    const auto inside = clip_to_grid(line, cells, {wanted.t_begin_mm, wanted.t_end_mm});
    if (!inside) return std::nullopt;
    line.origin += inside->t_enter * line.direction;
    return {{line, {0.0, inside->t_exit - inside->t_enter}}};
  }

  double value_of(double field) const { return slope * (field / factor) + intercept; }

  glm::i64vec3 cells;
  VolumeBricks bricks;
  CellFrame frame;
  double slope;
  double intercept;
  double factor;
  EmissionMap emission_of_field;

 protected:
  Walker(const Volume& volume, const EmissionMap& map)
      : cells(cell_count(volume.dims)),
        bricks(make_volume_bricks(volume)),
        frame(volume, cells),
        slope(volume.slope),
        intercept(volume.intercept),
        factor(field_factor(volume, bricks)),
        emission_of_field(in_field_units(map, slope, intercept, factor)) {
    for (std::size_t i = 0; i < bricks.least.size(); ++i) {
      bricks.least[i] *= factor;
      bricks.greatest[i] *= factor;
      if (factor < 0.0) std::swap(bricks.least[i], bricks.greatest[i]);
    }
  }
};

template <class T>
class ExactWalk::TypedWalker final : public ExactWalk::Walker {
 public:
  TypedWalker(const Volume& volume, const EmissionMap& map)
      : Walker(volume, map),
        samples_(samples_as<T>(volume)),
        stride_y_(volume.dims.x),
        stride_z_(volume.dims.x * volume.dims.y) {
    // Along an axis of one sample both ends of the one cell are that sample.
    const std::int64_t dx = volume.dims.x > 1 ? 1 : 0;
    const std::int64_t dy = volume.dims.y > 1 ? stride_y_ : 0;
    const std::int64_t dz = volume.dims.z > 1 ? stride_z_ : 0;
    corner_offset_ = {0, dx, dy, dx + dy, dz, dx + dz, dy + dz, dx + dy + dz};
  }

  double max_field(const CellLine& line, const LineInterval& interval, double floor,
                   double ceiling) const override {
    double best = floor;
    const auto on_brick = [&](std::size_t brick, double) { return bricks.greatest[brick] > best; };
    const auto on_cell = [&](const glm::ivec3& cell, double t_enter, double t_exit) {
      const T* base = first_corner(cell);
      if (greatest_corner(base) > best) {
        best = std::max(best, maximum(cubic_in(cell, base, line, t_enter, t_exit)));
      }
      return best < ceiling;
    };
    walk_grid(bricks, cells, line, interval, on_brick, on_cell);
    return best;
  }

  double integral(const CellLine& line, const LineInterval& interval) const override {
    double sum = 0.0;
    const EmissionKnot& first = emission_of_field.knots().front();
    const EmissionKnot& last = emission_of_field.knots().back();
    const auto on_brick = [&](std::size_t brick, double length_mm) {
      const bool dark = bricks.greatest[brick] <= first.value;
      if (!dark && bricks.least[brick] < last.value) return true;
      sum += (dark ? first.emission : last.emission) * length_mm;
      return false;
    };
    const auto on_cell = [&](const glm::ivec3& cell, double t_enter, double t_exit) {
      const T* base = first_corner(cell);
      const double mean =
          greatest_corner(base) <= first.value
              ? first.emission
              : mean_emission(emission_of_field, cubic_in(cell, base, line, t_enter, t_exit));
      sum += (t_exit - t_enter) * mean;
      return true;
    };
    walk_grid(bricks, cells, line, interval, on_brick, on_cell);
    return sum;
  }

 private:
  const T* first_corner(const glm::ivec3& cell) const {
    return samples_.data() + (cell.x + stride_y_ * cell.y + stride_z_ * cell.z);
  }

  /// In field units. Compared in the stored type: most cells end here.
  double greatest_corner(const T* base) const {
    T least = base[0];
    T greatest = base[0];
    for (std::size_t i = 1; i < 8; ++i) {
      least = std::min(least, base[corner_offset_[i]]);
      greatest = std::max(greatest, base[corner_offset_[i]]);
    }
    return factor * static_cast<double>(factor > 0.0 ? greatest : least);
  }

  BernsteinCubic cubic_in(const glm::ivec3& cell, const T* base, const CellLine& line,
                          double t_enter, double t_exit) const {
    CellCorners corners;
    for (std::size_t i = 0; i < 8; ++i) {
      corners[i] = factor * static_cast<double>(base[corner_offset_[i]]);
    }
    return cubic_along(corners, point_in_cell(line, cell, t_enter),
                       point_in_cell(line, cell, t_exit));
  }

  std::span<const T> samples_;
  std::int64_t stride_y_;
  std::int64_t stride_z_;
  std::array<std::int64_t, 8> corner_offset_{};
};

ExactWalk::ExactWalk(const Volume& volume, const EmissionMap& emission) {
  visit_scalar_type(volume.type, [&]<class T>(T) {
    walker_ = std::make_unique<const TypedWalker<T>>(volume, emission);
  });
}

ExactWalk::~ExactWalk() = default;
ExactWalk::ExactWalk(ExactWalk&&) noexcept = default;
ExactWalk& ExactWalk::operator=(ExactWalk&&) noexcept = default;

double ExactWalk::max_emission(const Ray& ray, const RayInterval& interval) const {
  const auto entered = walker_->enter(ray, interval);
  if (!entered) return 0.0;
  const EmissionMap& emission = walker_->emission_of_field;
  return emission(
      walker_->max_field(entered->first, entered->second, emission.lo(), emission.hi()));
}

double ExactWalk::max_value(const Ray& ray, const RayInterval& interval) const {
  const auto entered = walker_->enter(ray, interval);
  if (!entered) return std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return walker_->value_of(
      walker_->max_field(entered->first, entered->second, -kInfinity, kInfinity));
}

double ExactWalk::emission_integral(const Ray& ray, const RayInterval& interval) const {
  const auto entered = walker_->enter(ray, interval);
  return entered ? walker_->integral(entered->first, entered->second) : 0.0;
}

}  // namespace nacre
