#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace nacre {

/// The connectivity of a closed, oriented, manifold triangle mesh, edited by collapses and flips
/// that keep it one.
///
/// Half-edge 3 t + i runs along triangle t from its corner i to the next. Every half-edge has an
/// opposite, in the triangle on the other side. Vertices are numbers; positions are the user's.
class ClosedMesh {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  /// @param triangles     three vertices each
  /// @param vertex_count  one more than the greatest vertex
  ///
  /// A vertex where several fans of triangles touch becomes as many vertices.
  ///
  /// @throws Error  BadArgument unless every edge belongs to exactly two triangles, which run along
  ///                it in opposite directions
  ClosedMesh(std::span<const glm::uvec3> triangles, std::size_t vertex_count);

  std::size_t vertex_count() const noexcept { return outgoing_.size(); }
  std::size_t triangle_count() const noexcept { return vertex_.size() / 3; }  ///< dead ones too
  std::size_t half_edge_count() const noexcept { return vertex_.size(); }

  /// The vertex of the input that a vertex was made from.
  std::uint32_t source(std::uint32_t vertex) const noexcept { return source_[vertex]; }

  bool is_alive(std::size_t triangle) const noexcept { return vertex_[3 * triangle] != kNone; }
  glm::uvec3 triangle(std::size_t t) const noexcept {
    return {vertex_[3 * t], vertex_[3 * t + 1], vertex_[3 * t + 2]};
  }

  static std::uint32_t next(std::uint32_t h) noexcept { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t previous(std::uint32_t h) noexcept { return h % 3 == 0 ? h + 2 : h - 1; }
  std::uint32_t from(std::uint32_t h) const noexcept { return vertex_[h]; }
  std::uint32_t to(std::uint32_t h) const noexcept { return vertex_[next(h)]; }
  /// The corner of h's triangle that h does not touch.
  std::uint32_t apex(std::uint32_t h) const noexcept { return vertex_[previous(h)]; }
  std::uint32_t opposite(std::uint32_t h) const noexcept { return opposite_[h]; }

  /// A half-edge that leaves the vertex; kNone if no triangle is left at it.
  std::uint32_t outgoing(std::uint32_t vertex) const noexcept { return outgoing_[vertex]; }

  /// Calls `visit(h)` with the half-edges that leave a vertex, in clockwise order.
  template <class Visit>
  void for_each_outgoing(std::uint32_t vertex, Visit&& visit) const {
    const std::uint32_t first = outgoing_[vertex];
    if (first == kNone) return;
    std::uint32_t h = first;
    do {
      visit(h);
      h = next(opposite_[h]);
    } while (h != first);
  }

  std::size_t valence(std::uint32_t vertex) const;
  bool are_neighbours(std::uint32_t a, std::uint32_t b) const;

  /// Whether moving h's start onto its end leaves a manifold (the link condition): the two share
  /// exactly the two neighbours opposite the edge, and those keep three neighbours.
  bool can_collapse(std::uint32_t h) const;

  /// Moves h's start onto its end: one vertex and two triangles less.
  /// @pre  can_collapse(h)
  void collapse(std::uint32_t h);

  /// Whether h's edge can be exchanged for the other diagonal of its two triangles.
  bool can_flip(std::uint32_t h) const;

  /// Exchanges h's edge for the one between the two triangles' apices.
  /// @pre  can_flip(h)
  void flip(std::uint32_t h);

  /// Removes a vertex and its triangles. For all vertices of a component only: those that stay
  /// would keep pointing at it.
  void kill_vertex(std::uint32_t vertex);

 private:
  void link(std::uint32_t a, std::uint32_t b) {
    opposite_[a] = b;
    opposite_[b] = a;
  }
  bool is_least(std::uint32_t vertex) const;
  void kill_triangle(std::size_t triangle);
  void match_half_edges(std::size_t vertex_count);
  void split_fans();

  std::vector<std::uint32_t> vertex_;    ///< where each half-edge starts; kNone in dead triangles
  std::vector<std::uint32_t> opposite_;  ///< of each half-edge
  std::vector<std::uint32_t> outgoing_;  ///< of each vertex
  std::vector<std::uint32_t> source_;    ///< of each vertex
};

/// Where the vertices of a mesh made from a surface lie.
std::vector<glm::dvec3> positions_of(const ClosedMesh& mesh, const TriangleMesh& surface);

/// What is left of a mesh as a surface; vertices and triangles keep their order.
TriangleMesh live_surface(const ClosedMesh& mesh, std::span<const glm::dvec3> positions);

}  // namespace nacre
