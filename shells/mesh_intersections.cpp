#include "shells/mesh_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace nacre {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t,
                                                      CGAL::Box_intersection_d::ID_EXPLICIT>;

// Boxes below this number are compared all with all; CGAL's own choice for meshes.
constexpr std::ptrdiff_t kCutoff = 2000;

/// A surface as CGAL sees it, and the boxes of its triangles.
struct Surface {
  std::vector<Point> points;
  const std::vector<glm::uvec3>* triangles;
  std::vector<Box> boxes;

  const Point& corner(std::uint32_t triangle, int i) const {
    return points[(*triangles)[triangle][i]];
  }
};

Surface surface_of(const TriangleMesh& mesh) {
  Surface surface{{}, &mesh.triangles, {}};
  surface.points.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions) surface.points.emplace_back(p.x, p.y, p.z);
  surface.boxes.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Point& a = surface.corner(t, 0);
    const Point& b = surface.corner(t, 1);
    const Point& c = surface.corner(t, 2);
    if (!CGAL::collinear(a, b, c)) surface.boxes.emplace_back(a.bbox() + b.bbox() + c.bbox(), t);
  }
  return surface;
}

Kernel::Triangle_3 triangle(const Surface& surface, std::uint32_t t) {
  return {surface.corner(t, 0), surface.corner(t, 1), surface.corner(t, 2)};
}

/// On which sides of a plane points lie.
struct Sides {
  int above = 0;
  int below = 0;
};

/// Sides of triangle `s` of `other` seen from the plane of triangle `t`. The predicates are
/// filtered and far cheaper than an intersection test, which most pairs then need not have.
Sides sides(const Surface& surface, std::uint32_t t, const Surface& other, std::uint32_t s) {
  Sides count;
  for (int i = 0; i < 3; ++i) {
    const CGAL::Orientation side = CGAL::orientation(surface.corner(t, 0), surface.corner(t, 1),
                                                     surface.corner(t, 2), other.corner(s, i));
    count.above += side == CGAL::POSITIVE ? 1 : 0;
    count.below += side == CGAL::NEGATIVE ? 1 : 0;
  }
  return count;
}

/// Corners of two triangles at the same vertices: how many, and where.
struct Shared {
  int count = 0;
  std::array<int, 3> in_s{};
  std::array<int, 3> in_t{};
};

Shared shared_vertices(const glm::uvec3& s, const glm::uvec3& t) {
  Shared shared;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (s[i] != t[j] || shared.count == 3) continue;
      shared.in_s[static_cast<std::size_t>(shared.count)] = i;
      shared.in_t[static_cast<std::size_t>(shared.count)] = j;
      ++shared.count;
    }
  }
  return shared;
}

/// Two triangles at an edge lie on each other if all is in one plane, the third corners on one side
/// of the edge.
bool fold_over(const Surface& surface, std::uint32_t s, std::uint32_t t, const Shared& shared) {
  const int s_apex = 3 - shared.in_s[0] - shared.in_s[1];
  const int t_apex = 3 - shared.in_t[0] - shared.in_t[1];
  const Point& a = surface.corner(s, shared.in_s[0]);
  const Point& b = surface.corner(s, shared.in_s[1]);
  const Point& c = surface.corner(s, s_apex);
  const Point& d = surface.corner(t, t_apex);
  return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
}

/// Whether the side of `s` opposite the shared vertex meets `t`.
bool opposite_side_meets(const Surface& surface, std::uint32_t s, int shared_corner,
                         std::uint32_t t) {
  const Kernel::Segment_3 side(surface.corner(s, (shared_corner + 1) % 3),
                               surface.corner(s, (shared_corner + 2) % 3));
  return CGAL::do_intersect(triangle(surface, t), side);
}

bool intersect_themselves(const Surface& surface, std::uint32_t s, std::uint32_t t) {
  const Shared shared = shared_vertices((*surface.triangles)[s], (*surface.triangles)[t]);
  if (shared.count == 3) return true;
  if (shared.count == 2) return fold_over(surface, s, t, shared);
  // A shared vertex lies in both planes: the other two corners decide.
  const int others = 3 - shared.count;
  const Sides of_t = sides(surface, s, surface, t);
  if (of_t.above == others || of_t.below == others) return false;
  const Sides of_s = sides(surface, t, surface, s);
  if (of_s.above == others || of_s.below == others) return false;
  if (shared.count == 1) {
    return opposite_side_meets(surface, s, shared.in_s[0], t) ||
           opposite_side_meets(surface, t, shared.in_t[0], s);
  }
  return CGAL::do_intersect(triangle(surface, s), triangle(surface, t));
}

void count_pair(const Surface& a, std::uint32_t s, const Surface& b, std::uint32_t t,
                MutualIntersections& count) {
  const Sides of_t = sides(a, s, b, t);
  if (of_t.above == 3 || of_t.below == 3) return;
  const Sides of_s = sides(b, t, a, s);
  if (of_s.above == 3 || of_s.below == 3) return;
  if (!CGAL::do_intersect(triangle(a, s), triangle(b, t))) return;
  const bool crossing = of_t.above > 0 && of_t.below > 0 && of_s.above > 0 && of_s.below > 0;
  ++(crossing ? count.crossing : count.touching);
}

}  // namespace

std::size_t self_intersections(const TriangleMesh& mesh) {
  Surface surface = surface_of(mesh);
  std::size_t count = 0;
  CGAL::box_self_intersection_d(
      surface.boxes.begin(), surface.boxes.end(),
      [&](const Box& s, const Box& t) {
        if (intersect_themselves(surface, s.info(), t.info())) ++count;
      },
      kCutoff);
  return count;
}

MutualIntersections mutual_intersections(const TriangleMesh& a, const TriangleMesh& b) {
  Surface first = surface_of(a);
  Surface second = surface_of(b);
  MutualIntersections count;
  CGAL::box_intersection_d(
      first.boxes.begin(), first.boxes.end(), second.boxes.begin(), second.boxes.end(),
      [&](const Box& s, const Box& t) { count_pair(first, s.info(), second, t.info(), count); },
      kCutoff);
  return count;
}

}  // namespace nacre
