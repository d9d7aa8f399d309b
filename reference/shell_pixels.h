#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "core/camera.h"
#include "core/image.h"
#include "core/picture.h"
#include "reference/tool_rays.h"
#include "reference/triangle_crossing.h"

namespace nacre {

/// The ray through a pixel's centre, and what has been seen along it so far.
struct ShellPixel {
  explicit ShellPixel(const Ray& ray) : along(ray), direction(ray.direction) {}

  RayCoordinates along;
  glm::dvec3 direction;
  RayInterval interval;         ///< what shows: of the slab, before the tool; may be empty
  double beta_at_origin = 1.0;  ///< the cue, linear in t
  double beta_per_mm = 0.0;
  /// From where on crossings are counted, to know how many shells are around that point; NaN: not.
  double counted_from_mm = std::numeric_limits<double>::quiet_NaN();
  double zero_mm = 0.0;  ///< where the antiderivative of beta is 0
  double value = 0.0;    ///< of the picture
  int around = 0;        ///< shells around the point at `counted_from_mm`

  bool is_empty() const { return !(interval.t_begin_mm < interval.t_end_mm); }
  bool shows(double t) const { return t >= interval.t_begin_mm && t <= interval.t_end_mm; }
  double beta(double t) const { return beta_at_origin + beta_per_mm * t; }

  /// B(t), the integral of beta from `zero_mm` to t, mm.
  double beta_integral(double t) const { return (t - zero_mm) * (0.5 * (beta(zero_mm) + beta(t))); }
};

/// An axis-parallel box, LPS mm; empty if lo > hi.
struct ShellBounds {
  glm::dvec3 lo_mm{std::numeric_limits<double>::infinity()};
  glm::dvec3 hi_mm{-std::numeric_limits<double>::infinity()};
};

/// The rays through the pixels of some rows at a time, each made when it is first asked for: most
/// pixels of a picture see nothing. Those that tools are drawn in are all made at once.
class ShellPixels {
 public:
  /// @param camera  must outlive this, as what the options point to
  /// @param bounds  of the shells shown: where none can be around a point, none are counted
  /// @param layer   of the camera's size, for the tools that are seen; null without tools
  ShellPixels(const Camera& camera, const DepthCue& cue, const Slab& slab,
              const ShellBounds& bounds, const ToolRays* tools, ToolLayer* layer);

  /// Starts some rows.
  void begin(int first_row, int end_row);

  /// The pixel; those of a row are asked for by one thread at a time.
  ShellPixel& at(int x, int y) {
    const std::size_t i = index(x, y);
    if (made_[i] == 0) make(x, y);
    return slots_[i].pixel;
  }

  /// The pixel, if it was asked for.
  ShellPixel* find(int x, int y) {
    const std::size_t i = index(x, y);
    return made_[i] != 0 ? &slots_[i].pixel : nullptr;
  }

 private:
  /// Memory of a pixel that may not be there.
  union Slot {
    Slot() noexcept {}  // NOLINT(modernize-use-equals-default): that would be deleted
    ShellPixel pixel;
  };

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(camera_.size.x) * static_cast<std::size_t>(y - first_row_);
  }

  void make(int x, int y);

  const Camera& camera_;
  DepthCue cue_;
  Slab slab_;
  ShellBounds bounds_;
  const ToolRays* tools_;
  ToolLayer* layer_;
  int first_row_ = 0;
  std::size_t count_ = 0;          ///< of slots
  std::unique_ptr<Slot[]> slots_;  // NOLINT(modernize-avoid-c-arrays): memory as it comes
  std::vector<std::uint8_t> made_;
};

}  // namespace nacre
