#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "core/emission.h"
#include "core/triangle_mesh.h"
#include "shells/trilinear_field.h"

namespace nacre {

/// The largest emission of the samples in blocks of a volume.
class BrightestBlocks {
 public:
  static constexpr int kSide = 4;
  BrightestBlocks(const Volume& volume, const EmissionMap& emission);
  float at(const glm::ivec3& block) const noexcept {
    return most_[static_cast<std::size_t>(block.x) +
                 static_cast<std::size_t>(dims_.x) *
                     (static_cast<std::size_t>(block.y) +
                      static_cast<std::size_t>(dims_.y) * static_cast<std::size_t>(block.z))];
  }
  const glm::ivec3& dims() const noexcept { return dims_; }

 private:
  glm::ivec3 dims_;
  std::vector<float> most_;
};

class SurfaceVisibility {
 public:
  SurfaceVisibility(const TriangleMesh& surface, const TrilinearField& field,
                    const EmissionMap& emission, const BrightestBlocks& blocks, double hidden_from);
  double at(const glm::dvec3& p_mm) const noexcept;
  double mean() const noexcept { return mean_; }

 private:
  const TrilinearField& field_;
  glm::ivec3 dims_;
  std::vector<float> part_;
  double mean_ = 1.0;
};

}  // namespace nacre
