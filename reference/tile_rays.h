#pragma once

#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/camera.h"
#include "core/picture.h"
#include "reference/cell_kernel.h"
#include "reference/pixel_range.h"
#include "reference/walk_field.h"

namespace nacre {

/// A pixel's ray in cell coordinates, its visible part, and where on it t = 0 is.
struct PixelLine {
  CellLine line;
  LineInterval visible;
  double t_shift_mm;        ///< of the camera's ray (`picture_ray`), at the line's t = 0
  glm::dvec3 direction_mm;  ///< of that ray, of unit length
};

/// Parallel rays: pixel (x, y)'s is the corner's, moved (x + 1/2) `right` and (y + 1/2) `down`.
struct ParallelLines {
  CellLine corner;  ///< of the picture's upper left corner
  glm::dvec3 right{0.0};
  glm::dvec3 down{0.0};
};

/// The rays of a camera's pixels in cell coordinates, each counted from near the volume.
class PixelLines {
 public:
  /// @param field  outlives this object
  PixelLines(const WalkField& field, const Camera& camera, const Slab& slab);

  /// The ray through a pixel's centre; false where it misses the volume's box for certain (others
  /// may miss it too). Rays in or along a border plane are treated as `clip_to_grid` does.
  ///
  /// @param ray  written in place: returned, its copies cost a tenth of a picture's time
  bool find(int x, int y, PixelLine& ray) const {
    if (!is_plain_) return find_any(x, y, ray);
    put_line(x, y, ray.line);
    const glm::dvec3& p = ray.line.origin;
    const bool well_inside = p.x > least_.x && p.y > least_.y && p.z > least_.z && p.x < most_.x &&
                             p.y < most_.y && p.z < most_.z;
    if (!well_inside) return find_any(x, y, ray);
    ray.visible = visible_;
    ray.t_shift_mm = 0.0;
    ray.direction_mm = direction_mm_;
    return true;
  }

  /// Whether the volume's darkest is not 0, so that each ray through its box shows something; then
  /// `find` gives the part inside the box.
  bool shows_always() const { return shows_always_; }

  /// All rays at once, if they are parallel, no slab cuts them off, and nothing shows always.
  std::optional<ParallelLines> uncut() const {
    const bool cut = std::isfinite(visible_.t_enter) || std::isfinite(visible_.t_exit);
    if (camera_.perspective || cut || shows_always_) return std::nullopt;
    return parallel_;
  }

 private:
  bool find_any(int x, int y, PixelLine& ray) const;
  bool find_entered(int x, int y, PixelLine& ray) const;

  /// Orthographic.
  void put_line(int x, int y, CellLine& line) const {
    line.origin =
        parallel_.corner.origin + (x + 0.5) * parallel_.right + (y + 0.5) * parallel_.down;
    line.direction = parallel_.corner.direction;
  }

  const WalkField& field_;
  const Camera& camera_;
  Slab slab_;
  bool shows_always_;
  /// Orthographic, nothing shows always, and each ray is steep to planes or runs along them. Then
  /// rays with their origins within these bounds are as any others.
  bool is_plain_ = false;
  glm::dvec3 least_{0.0};
  glm::dvec3 most_{0.0};
  glm::dvec3 direction_mm_{0.0};
  /// Orthographic.
  ParallelLines parallel_;
  LineInterval visible_{0.0, 0.0};
};

/// The rays of a tile of pixels, in arrays for the kernel.
class TileRays {
 public:
  static constexpr int kSide = 32;  ///< pixels

  TileRays();

  /// No rays: what was put is hidden by best = infinity.
  void clear();

  /// @param x, y  within the tile
  void put(int x, int y, const PixelLine& ray, double best);

  /// The cue along a ray that was put.
  void set_cue(std::size_t ray, const LineCue& beta) {
    column(kBetaAt)[ray] = beta.at_enter;
    column(kBetaRise)[ray] = beta.rise_per_mm;
  }
  LineCue cue(std::size_t ray) const { return {column(kBetaAt)[ray], column(kBetaRise)[ray]}; }

  /// The arrays, as put so far.
  LaneRays lanes();

  static std::size_t index(int x, int y) {
    return static_cast<std::size_t>(y) * kStride + static_cast<std::size_t>(x);
  }

  double best(int x, int y) const { return column(kBest)[index(x, y)]; }

 private:
  // Columns; those of points and directions have three.
  static constexpr int kOrigin = 0;
  static constexpr int kDirection = 3;
  static constexpr int kInverse = 6;
  static constexpr int kSlack = 9;
  static constexpr int kBegin = 12;
  static constexpr int kEnd = 13;
  static constexpr int kBest = 14;
  static constexpr int kBetaAt = 15;
  static constexpr int kBetaRise = 16;
  static constexpr std::size_t kColumns = 17;
  static constexpr std::size_t kPadding = 4;  ///< a vector
  static constexpr std::size_t kStride = kSide + kPadding;
  static constexpr std::size_t kRays = kSide * kStride;

  double* column(int i) { return figures_.data() + static_cast<std::size_t>(i) * kRays; }
  const double* column(int i) const {
    return figures_.data() + static_cast<std::size_t>(i) * kRays;
  }

  std::vector<double> figures_;
  bool any_slack_ = false;
};

}  // namespace nacre
