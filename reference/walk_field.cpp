#include "reference/walk_field.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "core/volume_geometry.h"

namespace nacre {
namespace {

/// Beyond this magnitude sums of a few samples may overflow a double; they are scaled down.
constexpr double kLargeSample = 1e300;
constexpr double kScaleDown = 1.0 / 1024.0;

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

/// Along an axis of one sample both ends of the one cell are that sample.
std::array<std::int64_t, 8> corner_offsets(const glm::i64vec3& dims) {
  const std::int64_t dx = dims.x > 1 ? 1 : 0;
  const std::int64_t dy = dims.y > 1 ? dims.x : 0;
  const std::int64_t dz = dims.z > 1 ? dims.x * dims.y : 0;
  return {0, dx, dy, dx + dy, dz, dx + dz, dy + dz, dx + dy + dz};
}

/// The axis whose border plane a line passes last (entering) or first (leaving).
int face_axis(const CellLine& line, const glm::i64vec3& cells, bool entering) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  int face = 0;
  double t_face = entering ? -kInfinity : kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    if (line.direction[axis] == 0.0) continue;
    const LineInterval inside =
        clip_axis(line, axis, static_cast<double>(cells[axis]), {-kInfinity, kInfinity});
    const double t = entering ? inside.t_enter : inside.t_exit;
    if (entering ? t > t_face : t < t_face) {
      t_face = t;
      face = axis;
    }
  }
  return face;
}

}  // namespace

double least_field_above(const EmissionMap& map, double needed) {
  constexpr double kSafely = 1.0 - 1e-12;
  const double darkest = map.knots().front().emission;
  if (needed >= map.knots().back().emission) return std::numeric_limits<double>::infinity();
  if (needed * kSafely <= darkest) return map.lo();
  const double value = map.value_at(needed * kSafely);
  // In a piece that is hardly wider than an ulp the value may be rounded up.
  return map(value) <= needed ? value : map.lo();
}

CellFrame::CellFrame(const Volume& volume, const glm::i64vec3& cells)
    : world_from_cell(volume.world_from_voxel),
      cell_from_world(glm::inverse(world_from_cell)),
      center_mm(bounding_sphere(volume.dims, volume.world_from_voxel).center_mm),
      center_cell(0.5 * glm::dvec3(cells)) {}

CellLine CellFrame::line(const Ray& ray) const {
  return {center_cell + cell_from_world * (ray.origin_mm - center_mm),
          cell_from_world * ray.direction};
}

WalkField::WalkField(const Volume& source, const EmissionMap& map)
    : volume(&source),
      cells(cell_count(source.dims)),
      bricks(make_volume_bricks(source)),
      frame(source, cells),
      slope(source.slope),
      intercept(source.intercept),
      factor(field_factor(source, bricks)),
      emission_of_field(in_field_units(map, slope, intercept, factor)),
      brightest(bricks.least.size()),
      corner_offset(corner_offsets(source.dims)) {
  for (std::size_t i = 0; i < bricks.least.size(); ++i) {
    bricks.least[i] *= factor;
    bricks.greatest[i] *= factor;
    if (factor < 0.0) std::swap(bricks.least[i], bricks.greatest[i]);
    brightest[i] = emission_of_field(bricks.greatest[i]);
    brightest_of_all = std::max(brightest_of_all, brightest[i]);
  }
}

std::optional<EnteredLine> WalkField::enter(const Ray& ray, const RayInterval& wanted) const {
  CellLine line = frame.line(ray);
  const auto inside = clip_to_grid(line, cells, {wanted.t_begin_mm, wanted.t_end_mm});
  if (!inside) return std::nullopt;
  line.origin += inside->t_enter * line.direction;
  return {{line, {0.0, inside->t_exit - inside->t_enter}, inside->t_enter}};
}

std::optional<BoxPassage> WalkField::pass_through(const Ray& ray, const RayInterval& wanted) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CellLine line = frame.line(ray);
  const auto box = clip_to_grid(line, cells, {-kInfinity, kInfinity});
  if (!box) return std::nullopt;
  const double begin = std::max(box->t_enter, wanted.t_begin_mm);
  const double end = std::min(box->t_exit, wanted.t_end_mm);
  if (!(begin < end)) return std::nullopt;

  BoxPassage passage;
  if (begin == box->t_enter) passage.entry_axis = face_axis(line, cells, true);
  if (end == box->t_exit) passage.exit_axis = face_axis(line, cells, false);
  line.origin += begin * line.direction;
  passage.line = line;
  passage.interval = {0.0, end - begin};
  passage.t_begin_mm = begin;
  return passage;
}

LineCue WalkField::along(const CueField& cue, const Ray& ray, const EnteredLine& entered) const {
  const glm::dvec3 from_center = frame.world_from_cell * (entered.line.origin - frame.center_cell);
  return {cue.at_center + glm::dot(cue.rise_per_mm, frame.center_mm - cue.center_mm) +
              glm::dot(cue.rise_per_mm, from_center),
          glm::dot(cue.rise_per_mm, ray.direction)};
}

}  // namespace nacre
