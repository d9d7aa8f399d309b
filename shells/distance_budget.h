#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shells/star.h"

namespace nacre {

/// Bounds the distance between a surface and what it was, by what each change moves: a triangle
/// carries the sum of the distances of the changes that led to it.
class DistanceBudget {
 public:
  /// @param tolerance_mm  0: no bound
  DistanceBudget(double tolerance_mm, std::size_t face_count)
      : tolerance_(tolerance_mm), spent_(tolerance_mm > 0.0 ? face_count : 0, 0.0f) {}

  /// Whether the star may have its apex at p.
  bool allows(const Star& star, const glm::dvec3& p) const;

  /// Notes that it has.
  void commit(const Star& star, const glm::dvec3& p);

 private:
  double spent(const Star& star) const;

  double tolerance_;
  std::vector<float> spent_;  ///< of each face
};

}  // namespace nacre
