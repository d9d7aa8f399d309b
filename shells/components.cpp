#include "shells/components.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shells/disjoint_sets.h"

namespace nacre {
namespace {

// A point of a triangle that no symmetry of lattices puts over an edge of another.
constexpr double kWeightA = 0.4142135623730950;
constexpr double kWeightB = 0.3660254037844386;

void extend(Component& component, const glm::vec3& p) {
  component.lo = glm::min(component.lo, p);
  component.hi = glm::max(component.hi, p);
}

glm::dvec3 corner(const TriangleMesh& mesh, std::uint32_t triangle, int i) {
  return glm::dvec3(mesh.positions[mesh.triangles[triangle][i]]);
}

glm::dvec3 probe_point(const TriangleMesh& mesh, const Component& component) {
  const std::uint32_t t = component.first_triangle;
  return kWeightA * corner(mesh, t, 0) + kWeightB * corner(mesh, t, 1) +
         (1.0 - kWeightA - kWeightB) * corner(mesh, t, 2);
}

/// Twice the signed area of a, b, p seen from above; the same but for its sign for b, a, p.
double side(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p) {
  const bool swapped = b.x < a.x || (b.x == a.x && b.y < a.y);
  const glm::dvec3& u = swapped ? b : a;
  const glm::dvec3& v = swapped ? a : b;
  const double area = (v.x - u.x) * (p.y - u.y) - (v.y - u.y) * (p.x - u.x);
  return swapped ? -area : area;
}

/// +1 if a ray along +z from p leaves through the triangle, -1 if it enters, 0 if it misses.
int crossing_above(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                   const glm::dvec3& p) {
  const double ab = side(a, b, p);
  const double bc = side(b, c, p);
  const double ca = side(c, a, p);
  const bool upward = ab > 0.0 && bc > 0.0 && ca > 0.0;
  const bool downward = ab < 0.0 && bc < 0.0 && ca < 0.0;
  if (!upward && !downward) return 0;
  const double z = (bc * a.z + ca * b.z + ab * c.z) / (ab + bc + ca);
  if (z <= p.z) return 0;
  return upward ? 1 : -1;
}

/// Triangles by the columns of a grid over the xy plane.
class Columns {
 public:
  Columns(const TriangleMesh& mesh, const Components& components) : mesh_(mesh) {
    lo_ = components.list.front().lo;
    glm::vec3 hi = components.list.front().hi;
    for (const Component& component : components.list) {
      lo_ = glm::min(lo_, component.lo);
      hi = glm::max(hi, component.hi);
    }
    const double wanted = std::sqrt(static_cast<double>(mesh.triangles.size()) / kTrianglesAColumn);
    side_ = std::clamp(static_cast<int>(wanted), 1, kMostColumns);
    size_ = glm::max((hi - lo_) / static_cast<float>(side_), glm::vec3(1e-30F));
    fill(components);
  }

  /// Calls `visit` with the triangles of outer surfaces whose column holds the point.
  template <class Visit>
  void at(const glm::dvec3& p, Visit&& visit) const {
    const std::size_t cell = index(column(p.x, 0), column(p.y, 1));
    for (std::size_t i = begin_[cell]; i < begin_[cell + 1]; ++i) visit(triangles_[i]);
  }

 private:
  static constexpr double kTrianglesAColumn = 8.0;
  static constexpr int kMostColumns = 2048;

  int column(double x, int axis) const {
    return std::clamp(static_cast<int>((x - lo_[axis]) / size_[axis]), 0, side_ - 1);
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(side_) * static_cast<std::size_t>(y);
  }

  template <class Visit>
  void for_each_cell(std::uint32_t triangle, Visit&& visit) const {
    glm::vec3 lo = mesh_.positions[mesh_.triangles[triangle].x];
    glm::vec3 hi = lo;
    for (int i = 1; i < 3; ++i) {
      lo = glm::min(lo, mesh_.positions[mesh_.triangles[triangle][i]]);
      hi = glm::max(hi, mesh_.positions[mesh_.triangles[triangle][i]]);
    }
    for (int y = column(lo.y, 1); y <= column(hi.y, 1); ++y) {
      for (int x = column(lo.x, 0); x <= column(hi.x, 0); ++x) visit(index(x, y));
    }
  }

  /// Counts, then places.
  void fill(const Components& components) {
    const auto is_outer = [&](std::uint32_t t) {
      return components.list[components.of_triangle[t]].volume_mm3 > 0.0;
    };
    const auto count = static_cast<std::uint32_t>(mesh_.triangles.size());
    begin_.assign(index(0, side_) + 1, 0);
    for (std::uint32_t t = 0; t < count; ++t) {
      if (is_outer(t)) for_each_cell(t, [&](std::size_t cell) { ++begin_[cell + 1]; });
    }
    for (std::size_t cell = 1; cell < begin_.size(); ++cell) begin_[cell] += begin_[cell - 1];
    triangles_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t t = 0; t < count; ++t) {
      if (is_outer(t)) for_each_cell(t, [&](std::size_t cell) { triangles_[next[cell]++] = t; });
    }
  }

  const TriangleMesh& mesh_;
  int side_ = 1;
  glm::vec3 lo_{0.0F};
  glm::vec3 size_{1.0F};
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> triangles_;
};

/// Signed crossings of a ray with a component.
struct Winding {
  std::uint32_t component;
  int crossings;
};

void add_crossing(std::vector<Winding>& windings, std::uint32_t component, int crossing) {
  const auto found = std::find_if(windings.begin(), windings.end(), [&](const Winding& winding) {
    return winding.component == component;
  });
  if (found != windings.end()) {
    found->crossings += crossing;
  } else {
    windings.push_back({component, crossing});
  }
}

}  // namespace

Components find_components(const TriangleMesh& mesh) {
  DisjointSets vertices(mesh.positions.size());
  for (const glm::uvec3& t : mesh.triangles) {
    vertices.join(t.x, t.y);
    vertices.join(t.y, t.z);
  }
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> number(mesh.positions.size(), kNone);
  Components components;
  components.of_triangle.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint32_t& index = number[vertices.root(mesh.triangles[t].x)];
    if (index == kNone) {
      index = static_cast<std::uint32_t>(components.list.size());
      const glm::vec3& p = mesh.positions[mesh.triangles[t].x];
      components.list.push_back({t, 0, 0.0, p, p});
    }
    Component& component = components.list[index];
    components.of_triangle.push_back(index);
    ++component.triangles;
    // Seen from a point of the component: far from the origin volumes of specks would drown.
    const glm::dvec3 eye = corner(mesh, component.first_triangle, 0);
    component.volume_mm3 +=
        glm::dot(corner(mesh, t, 0) - eye,
                 glm::cross(corner(mesh, t, 1) - eye, corner(mesh, t, 2) - eye)) /
        6.0;
    for (int i = 0; i < 3; ++i) extend(component, mesh.positions[mesh.triangles[t][i]]);
  }
  return components;
}

std::vector<bool> inner_components(const TriangleMesh& mesh, const Components& components) {
  std::vector<bool> inner(components.list.size(), false);
  if (components.list.size() < 2) return inner;
  const Columns columns(mesh, components);
  std::vector<Winding> windings;
  for (std::uint32_t k = 0; k < components.list.size(); ++k) {
    const glm::dvec3 p = probe_point(mesh, components.list[k]);
    windings.clear();
    columns.at(p, [&](std::uint32_t t) {
      const std::uint32_t owner = components.of_triangle[t];
      if (owner == k) return;
      const int crossing =
          crossing_above(corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2), p);
      if (crossing != 0) add_crossing(windings, owner, crossing);
    });
    inner[k] = std::any_of(windings.begin(), windings.end(),
                           [](const Winding& winding) { return winding.crossings == 1; });
  }
  return inner;
}

}  // namespace nacre
