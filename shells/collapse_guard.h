#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "shells/simplify.h"

namespace nacre {

/// One triangle of a fan: its apex is the vertex that moves, a and b follow it counter-clockwise.
struct FanTriangle {
  glm::dvec3 a;
  glm::dvec3 b;
  std::uint32_t face;
};

/// A collapse: the fan of triangles about a vertex gets another apex, and loses the triangles that
/// have it as a corner already.
struct FanMove {
  glm::dvec3 before;
  glm::dvec3 after;
  std::vector<FanTriangle> kept;
  std::vector<FanTriangle> removed;
};

/// Decides whether a collapse keeps the bounds of `SimplifyOptions`, and remembers per triangle
/// what has been spent.
class CollapseGuard {
 public:
  CollapseGuard(const SimplifyOptions& options, std::size_t face_count);

  /// Sets what a triangle of the input has to answer for.
  void add_face(std::uint32_t face, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

  /// Whether the collapse is allowed. Cheap reasons to refuse come first.
  bool allows(const FanMove& move) const;

  /// Notes that the collapse was made.
  void commit(const FanMove& move);

 private:
  bool keeps_shape(const FanMove& move) const;
  bool keeps_error(const FanMove& move) const;
  bool keeps_distance(const FanMove& move) const;
  double distance_moved(const FanMove& move, double enough) const;
  double distance_spent(const FanMove& move) const;
  double error_over(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) const;

  const SimplifyOptions& options_;
  std::vector<float> face_error_;     ///< sampled, of each triangle as it is
  std::vector<float> face_distance_;  ///< bound of the distance to the input
};

}  // namespace nacre
