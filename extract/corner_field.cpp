#include "extract/corner_field.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace nacre {
namespace {

/// Products of two values beyond these would overflow or lose bits.
constexpr double kLargeValue = 1e150;
constexpr double kSmallValue = 1e-130;

/// Waist points lie between the saddle and the contour's slice, off both by this part of the way.
constexpr double kLeastWaist = 1.0 / 16;

/// The field as a polynomial: c + b . (x, y, z) + yz_ y z + xz_ x z + xy_ x y + h x y z.
struct Trilinear {
  double c;
  glm::dvec3 b;
  double yz, xz, xy;
  double h;

  explicit Trilinear(const CornerField& f)
      : c(f[0]),
        b(f[1] - f[0], f[2] - f[0], f[4] - f[0]),
        yz(f[6] - f[4] - f[2] + f[0]),
        xz(f[5] - f[4] - f[1] + f[0]),
        xy(f[3] - f[2] - f[1] + f[0]),
        h((f[7] - f[6] - f[5] + f[4]) - (f[3] - f[2] - f[1] + f[0])) {}

  double operator()(const glm::dvec3& p) const {
    return c + b.x * p.x + b.y * p.y + b.z * p.z + yz * p.y * p.z + xz * p.x * p.z +
           xy * p.x * p.y + h * p.x * p.y * p.z;
  }

  /// Mixed second derivatives d2/dydz, d2/dxdz, d2/dxdy.
  glm::dvec3 mixed(const glm::dvec3& p) const { return {yz + h * p.x, xz + h * p.y, xy + h * p.z}; }
};

/// The x coordinates of the critical points: with y and z eliminated, a quadratic.
std::array<double, 2> critical_x(const Trilinear& f) {
  const double q = f.b.x * f.h - f.xy * f.xz;
  const double r = f.b.x * f.yz * f.yz - f.yz * (f.xy * f.b.z + f.xz * f.b.y) + f.h * f.b.y * f.b.z;
  const double half_b = f.yz * q;
  const double root = std::sqrt(half_b * half_b - f.h * q * r);
  // The root of larger size first, the other from their product: h = 0 is no special case.
  const double larger = -(half_b + std::copysign(root, half_b));
  return {larger / (f.h * q), r / larger};
}

bool is_within(const glm::dvec3& p, double margin) {
  const auto within = [margin](double t) { return t >= margin && t <= 1.0 - margin; };
  return within(p.x) && within(p.y) && within(p.z);
}

/// A saddle of the cell that joins what is inside: its place, and the direction of one of the two
/// opposite octants into which the field rises from it.
struct Saddle {
  glm::dvec3 place{0.0};
  std::array<bool, 3> toward_high{};  ///< the rising octant's direction along each axis
  double value = 0.0;                 ///< at least 0
  glm::dvec3 mixed{0.0};
};

/// The joining saddle at or above the level within the cell. (Of a trilinear field's two saddles
/// one joins, falling values, and the other splits.)
std::optional<Saddle> joining_saddle(const CornerField& field, double margin) {
  const Trilinear f(field);
  for (const double x : critical_x(f)) {
    if (!(x >= margin && x <= 1.0 - margin)) continue;  // also not a number
    const double u = f.yz + f.h * x;
    const glm::dvec3 place(x, -(f.b.z + f.xz * x) / u, -(f.b.y + f.xy * x) / u);
    if (!is_within(place, margin)) continue;
    const glm::dvec3 mixed = f.mixed(place);
    const double value = f(place);
    if (!(mixed.x * mixed.y * mixed.z > 0.0) || !(value >= 0.0)) continue;
    // Flipping the axis of a positive derivative among two negative ones makes all three positive.
    Saddle saddle{
        .place = place, .toward_high = {true, true, true}, .value = value, .mixed = mixed};
    if (mixed.y < 0.0 || mixed.x < 0.0) {
      for (int axis = 0; axis < 3; ++axis) {
        saddle.toward_high[static_cast<std::size_t>(axis)] = mixed[axis] < 0.0;
      }
    }
    return saddle;
  }
  return std::nullopt;
}

/// An inside corner of the part that the saddle reaches in an octant. The field is not below the
/// saddle's value on the three edges at the octant's corner, beside the saddle.
unsigned reached_corner(unsigned mask, const std::array<bool, 3>& toward_high) {
  unsigned corner = 0;
  for (unsigned axis = 0; axis < 3; ++axis) corner |= (toward_high[axis] ? 1u : 0u) << axis;
  return (mask >> corner & 1u) != 0 ? corner : corner ^ 1u;
}

/// The boundary part on one side of a loop, by the names of `CellCase::region`.
unsigned region_beside(const CellCase& cell, const CellLoop& loop, unsigned mask, bool inside) {
  const auto [a, b] = kEdgesOfCell[loop.edges[0]];
  return cell.region[((mask >> a & 1u) != 0) == inside ? a : b];
}

/// Sets the two loops that separate the parts `plus` and `minus` from one part between them.
bool find_loops(const CellCase& cell, unsigned mask, unsigned plus, unsigned minus,
                Tunnel& tunnel) {
  for (std::size_t i = 0; i < cell.loop_count; ++i) {
    if (region_beside(cell, cell.loops[i], mask, true) != plus) continue;
    for (std::size_t j = 0; j < cell.loop_count; ++j) {
      if (region_beside(cell, cell.loops[j], mask, true) != minus) continue;
      if (region_beside(cell, cell.loops[i], mask, false) !=
          region_beside(cell, cell.loops[j], mask, false)) {
        continue;
      }
      tunnel.plus_loop = i;
      tunnel.minus_loop = j;
      return true;
    }
  }
  return false;
}

/// Six points of the tube about the saddle, each in a slice through it across one axis. There the
/// field is value - |mixed| |da db| in the two falling quadrants; the point is the one of the
/// contour on the line from the saddle to the quadrant's corner.
std::array<glm::dvec3, 6> waist_about(const Saddle& saddle) {
  // In the frame whose axes point into the rising octant: counter-clockwise about (1, 1, 1).
  constexpr std::array<std::array<int, 3>, 6> kDirections{
      {{1, -1, 0}, {1, 0, -1}, {0, 1, -1}, {-1, 1, 0}, {-1, 0, 1}, {0, -1, 1}}};
  std::array<glm::dvec3, 6> waist;
  for (std::size_t i = 0; i < 6; ++i) {
    glm::dvec3 to_corner(0.0);
    double mixed = 0.0;
    double area = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const int direction = kDirections[i][static_cast<std::size_t>(axis)];
      if (direction == 0) {
        mixed = std::abs(saddle.mixed[axis]);
        continue;
      }
      const bool high = (direction > 0) == saddle.toward_high[static_cast<std::size_t>(axis)];
      to_corner[axis] = (high ? 1.0 : 0.0) - saddle.place[axis];
      area *= std::abs(to_corner[axis]);
    }
    const double part = std::sqrt(saddle.value / (mixed * area));
    waist[i] = saddle.place + to_corner * std::clamp(part, kLeastWaist, 1.0 - kLeastWaist);
  }
  return waist;
}

/// The tunnel through which inside parts are joined.
bool find_inside_tunnel(const CornerField& field, unsigned mask, const CellCase& cell,
                        double margin, Tunnel& tunnel) {
  const std::optional<Saddle> saddle = joining_saddle(field, margin);
  if (!saddle) return false;
  std::array<bool, 3> opposite{};
  for (std::size_t axis = 0; axis < 3; ++axis) opposite[axis] = !saddle->toward_high[axis];
  const unsigned plus = cell.region[reached_corner(mask, saddle->toward_high)];
  const unsigned minus = cell.region[reached_corner(mask, opposite)];
  if (plus == minus || !find_loops(cell, mask, plus, minus, tunnel)) return false;
  tunnel.waist = waist_about(*saddle);
  // The plus loop's disc would face away from the rising octant: clockwise about it. A frame of an
  // odd number of flipped axes shows that as counter-clockwise.
  const bool mirrored = !(saddle->toward_high[0] ^ saddle->toward_high[1] ^ saddle->toward_high[2]);
  if (!mirrored) std::ranges::reverse(tunnel.waist);
  return true;
}

}  // namespace

bool joined_in_face(const CornerField& field, unsigned mask, const CellFace& face) {
  std::array<double, 4> values{};
  double largest = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    values[i] = field[face.corners[i]];
    largest = std::max(largest, std::abs(values[i]));
  }
  if (largest > kLargeValue || largest < kSmallValue) {
    // A power of two changes no bit of the values.
    const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
    for (double& value : values) value = std::scalbn(value, -exponent);
  }
  const double first = values[0] * values[2];
  const double second = values[1] * values[3];
  const bool first_is_inside = (mask >> face.corners[0] & 1u) != 0;
  return first_is_inside ? first >= second : second >= first;
}

glm::dvec3 edge_point(const CornerField& field, unsigned edge,
                      const std::array<double, 3>& margins) {
  const auto [a, b] = kEdgesOfCell[edge];
  const std::size_t axis = edge / 4;
  const double t = field[a] / (field[a] - field[b]);
  glm::dvec3 point(a & 1, a >> 1 & 1, a >> 2 & 1);
  point[static_cast<int>(axis)] = std::clamp(t, margins[axis], 1.0 - margins[axis]);
  return point;
}

bool find_tunnel(const CornerField& field, unsigned mask, const CellCase& cell, double margin,
                 Tunnel& tunnel) {
  CornerField scaled = field;
  double largest = 0.0;
  for (const double value : field) largest = std::max(largest, std::abs(value));
  if (!(largest > 0.0)) return false;
  for (double& value : scaled) value /= largest;
  if (find_inside_tunnel(scaled, mask, cell, margin, tunnel)) return true;
  // What is outside is joined iff it is joined inside the negated field. The loops then run the
  // other way round.
  for (double& value : scaled) value = -value;
  if (!find_inside_tunnel(scaled, ~mask & 0xffu, cell, margin, tunnel)) return false;
  std::ranges::reverse(tunnel.waist);
  return true;
}

}  // namespace nacre
