#pragma once

#include <algorithm>
#include <glm/vec3.hpp>
#include <span>

#include "reference/cubic.h"
#include "reference/grid_walk.h"
#include "reference/trilinear_line.h"
#include "reference/walk_field.h"

namespace nacre {

/// The cells of a volume in its stored type T, read in field units.
template <class T>
class CellReader {
 public:
  explicit CellReader(const WalkField& field)
      : field_(field),
        samples_(samples_as<T>(*field.volume)),
        stride_y_(field.volume->dims.x),
        stride_z_(field.volume->dims.x * field.volume->dims.y) {}

  const T* first_corner(const glm::ivec3& cell) const {
    return samples_.data() + (cell.x + stride_y_ * cell.y + stride_z_ * cell.z);
  }

  /// Compared in the stored type: most cells end here.
  double greatest_corner(const T* base) const {
    const auto [least, greatest] = stored_range(base);
    return field_.factor * static_cast<double>(field_.factor > 0.0 ? greatest : least);
  }

  struct Range {
    double least;
    double greatest;
  };

  /// What the field can be in a cell.
  Range corner_range(const T* base) const {
    const auto [least, greatest] = stored_range(base);
    const double a = field_.factor * static_cast<double>(least);
    const double b = field_.factor * static_cast<double>(greatest);
    return field_.factor > 0.0 ? Range{a, b} : Range{b, a};
  }

  CellCorners corners(const T* base) const {
    CellCorners corners;
    for (std::size_t i = 0; i < 8; ++i) {
      corners[i] = field_.factor * static_cast<double>(base[field_.corner_offset[i]]);
    }
    return corners;
  }

  BernsteinCubic cubic_in(const glm::ivec3& cell, const T* base, const CellLine& line,
                          double t_enter, double t_exit) const {
    return cubic_along(corners(base), point_in_cell(line, cell, t_enter),
                       point_in_cell(line, cell, t_exit));
  }

 private:
  struct Stored {
    T least;
    T greatest;
  };

  Stored stored_range(const T* base) const {
    Stored range{base[0], base[0]};
    for (std::size_t i = 1; i < 8; ++i) {
      range.least = std::min(range.least, base[field_.corner_offset[i]]);
      range.greatest = std::max(range.greatest, base[field_.corner_offset[i]]);
    }
    return range;
  }

  const WalkField& field_;
  std::span<const T> samples_;
  std::int64_t stride_y_;
  std::int64_t stride_z_;
};

/// Calls `function(CellReader<T>)` for the type that the volume is stored in.
template <class Function>
decltype(auto) with_cells(const WalkField& field, Function&& function) {
  return visit_scalar_type(field.volume->type, [&]<class T>(T) -> decltype(auto) {
    return function(CellReader<T>(field));
  });
}

}  // namespace nacre
