#include "shells/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "shells/closed_mesh.h"

namespace nacre {
namespace {

constexpr int kNewtonSteps = 6;
constexpr double kCloseEnough = 0.1;  // of the tolerance
constexpr double kLeastTurn = 0.05;   // cosine between a triangle's normal and a part's
constexpr int kHalvings = 2;          // of how far a vertex goes, before it stays

/// The point nearest to the field's zero among those that Newton's method comes by from p, along
/// the gradient.
glm::dvec3 nearest_zero(const SurfaceField& field, const glm::dvec3& p, double enough,
                        double reach) {
  glm::dvec3 best = p;
  glm::dvec3 q = p;
  FieldSample at = field(q);
  double least = std::abs(at.error);
  for (int i = 0; i < kNewtonSteps && least > enough; ++i) {
    const double squared_slope = glm::dot(at.gradient, at.gradient);
    if (!(squared_slope > 0.0)) break;
    glm::dvec3 step = -at.error / squared_slope * at.gradient;
    const double length = glm::length(step);
    if (length > 0.5 * reach) step *= 0.5 * reach / length;
    q += step;
    if (glm::distance(q, p) > reach) break;
    at = field(q);
    if (std::abs(at.error) >= least) continue;
    least = std::abs(at.error);
    best = q;
  }
  return best;
}

/// One round: which edges are divided, and where.
class Divider {
 public:
  Divider(const TriangleMesh& surface, const SurfaceField& field, const RefineOptions& options)
      : surface_(surface),
        field_(field),
        options_(options),
        mesh_(surface.triangles, surface.positions.size()),
        middle_(mesh_.half_edge_count(), ClosedMesh::kNone) {}

  bool mark();
  /// Draws back new vertices about which a triangle's parts would turn too far, or over.
  void straighten();
  TriangleMesh divided() const;

 private:
  glm::dvec3 position(std::uint32_t v) const {
    return glm::dvec3(surface_.positions[mesh_.source(v)]);
  }
  bool strays(const glm::dvec3& p) const {
    return std::abs(field_(p).error) > options_.error_tolerance;
  }
  glm::dvec3 new_position(std::uint32_t v) const {
    return v < mesh_.vertex_count() ? position(v) : glm::dvec3(added_[v - mesh_.vertex_count()]);
  }
  void divide(std::uint32_t h);
  bool parts_turn(std::size_t t);
  bool draw_back(std::uint32_t h);
  void add_triangles(std::size_t t, std::vector<glm::uvec3>& triangles) const;

  const TriangleMesh& surface_;
  const SurfaceField& field_;
  const RefineOptions& options_;
  ClosedMesh mesh_;
  std::vector<std::uint32_t> middle_;  ///< of each half-edge: the number of its new vertex
  std::vector<glm::vec3> added_;
  std::vector<int> halvings_;      ///< of each vertex added
  std::vector<glm::uvec3> parts_;  ///< of the triangle at hand
};

void Divider::divide(std::uint32_t h) {
  if (middle_[h] != ClosedMesh::kNone) return;
  const glm::dvec3 a = position(mesh_.from(h));
  const glm::dvec3 b = position(mesh_.to(h));
  const double reach = std::min(options_.reach_mm, 0.5 * glm::distance(a, b));
  middle_[h] = middle_[mesh_.opposite(h)] =
      static_cast<std::uint32_t>(mesh_.vertex_count() + added_.size());
  added_.emplace_back(
      nearest_zero(field_, 0.5 * (a + b), kCloseEnough * options_.error_tolerance, reach));
}

/// Whether anything is to be divided.
bool Divider::mark() {
  for (std::uint32_t h = 0; h < mesh_.half_edge_count(); ++h) {
    if (h < mesh_.opposite(h) && strays(0.5 * (position(mesh_.from(h)) + position(mesh_.to(h))))) {
      divide(h);
    }
  }
  for (std::uint32_t h = 0; h < mesh_.half_edge_count(); h += 3) {
    const glm::uvec3 t = mesh_.triangle(h / 3);
    if (!strays((position(t.x) + position(t.y) + position(t.z)) / 3.0)) continue;
    for (std::uint32_t i = 0; i < 3; ++i) divide(h + i);
  }
  return !added_.empty();
}

/// Whether a part of t turns too far against it.
bool Divider::parts_turn(std::size_t t) {
  const auto h = static_cast<std::uint32_t>(3 * t);
  if (middle_[h] == ClosedMesh::kNone && middle_[h + 1] == ClosedMesh::kNone &&
      middle_[h + 2] == ClosedMesh::kNone) {
    return false;
  }
  std::vector<glm::uvec3>& parts = parts_;
  parts.clear();
  add_triangles(t, parts);
  const auto normal = [&](const glm::uvec3& p) {
    const glm::dvec3 a = new_position(p.x);
    return glm::cross(new_position(p.y) - a, new_position(p.z) - a);
  };
  const glm::dvec3 whole = normal(mesh_.triangle(t));
  return std::any_of(parts.begin(), parts.end(), [&](const glm::uvec3& p) {
    const glm::dvec3 part = normal(p);
    return glm::dot(part, whole) < kLeastTurn * glm::length(part) * glm::length(whole);
  });
}

/// @return  whether the vertex on h's edge was not there already
bool Divider::draw_back(std::uint32_t h) {
  if (middle_[h] == ClosedMesh::kNone) return false;
  const std::size_t i = middle_[h] - mesh_.vertex_count();
  if (halvings_[i] > kHalvings) return false;
  const glm::vec3 middle(0.5 * (position(mesh_.from(h)) + position(mesh_.to(h))));
  added_[i] = halvings_[i] == kHalvings ? middle : 0.5f * (added_[i] + middle);
  ++halvings_[i];
  return true;
}

/// Drawn back to the middles of their edges, parts lie in their triangle's plane: this ends.
void Divider::straighten() {
  halvings_.assign(added_.size(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t h = 0; h < mesh_.half_edge_count(); h += 3) {
      if (!parts_turn(h / 3)) continue;
      for (std::uint32_t i = 0; i < 3; ++i) changed = draw_back(h + i) || changed;
    }
  }
}

/// The one to four triangles that t becomes.
void Divider::add_triangles(std::size_t t, std::vector<glm::uvec3>& triangles) const {
  const auto h = static_cast<std::uint32_t>(3 * t);
  const auto is_divided = [&](std::uint32_t i) { return middle_[h + i] != ClosedMesh::kNone; };
  const auto count = is_divided(0) + is_divided(1) + is_divided(2);
  // Turned so that the first side is divided where any is, and the last is not where any is not.
  std::uint32_t first = 0;
  if (count == 1 || count == 2) {
    while (!is_divided(first) || is_divided((first + 2) % 3)) ++first;
  }
  const auto corner = [&](std::uint32_t i) { return mesh_.from(h + (first + i) % 3); };
  const auto middle = [&](std::uint32_t i) { return middle_[h + (first + i) % 3]; };
  const std::uint32_t a = corner(0), b = corner(1), c = corner(2);
  if (count == 0) {
    triangles.emplace_back(a, b, c);
  } else if (count == 1) {
    triangles.insert(triangles.end(), {{a, middle(0), c}, {middle(0), b, c}});
  } else if (count == 2) {
    // The shorter diagonal of what is left of corner b.
    triangles.emplace_back(middle(0), b, middle(1));
    if (glm::distance(new_position(a), new_position(middle(1))) <
        glm::distance(new_position(middle(0)), new_position(c))) {
      triangles.insert(triangles.end(), {{a, middle(0), middle(1)}, {a, middle(1), c}});
    } else {
      triangles.insert(triangles.end(), {{a, middle(0), c}, {middle(0), middle(1), c}});
    }
  } else {
    triangles.insert(triangles.end(), {{a, middle(0), middle(2)},
                                       {middle(0), b, middle(1)},
                                       {middle(2), middle(1), c},
                                       {middle(0), middle(1), middle(2)}});
  }
}

TriangleMesh Divider::divided() const {
  TriangleMesh result;
  result.positions.reserve(mesh_.vertex_count() + added_.size());
  for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
    result.positions.push_back(surface_.positions[mesh_.source(v)]);
  }
  result.positions.insert(result.positions.end(), added_.begin(), added_.end());
  // Every new vertex makes two triangles more.
  result.triangles.reserve(mesh_.triangle_count() + 2 * added_.size());
  for (std::size_t t = 0; t < mesh_.triangle_count(); ++t) add_triangles(t, result.triangles);
  return result;
}

}  // namespace

TriangleMesh refine(const TriangleMesh& surface, const SurfaceField& field,
                    const RefineOptions& options) {
  TriangleMesh refined = surface;
  for (int round = 0; round < options.rounds; ++round) {
    Divider divider(refined, field, options);
    if (!divider.mark()) break;
    divider.straighten();
    refined = divider.divided();
  }
  return refined;
}

}  // namespace nacre
