#pragma once

#include <array>
#include <functional>

#include "core/camera.h"
#include "core/volume.h"

namespace nacre::testing {

/// The trilinear field of a 2 x 2 x 2 volume of doubles along a ray, in extended precision and
/// power form: it shares nothing with the walk but the corners and the ray.
class ExtendedCell {
 public:
  using Function = std::function<long double(long double t, long double value)>;

  /// @param volume  identity geometry
  ExtendedCell(const Volume& volume, const Ray& ray);

  long double t_enter() const { return t_enter_; }
  long double t_exit() const { return t_exit_; }

  /// The field at origin + t * direction.
  long double at(long double t) const;

  /// The largest value of a continuous function along the ray: a grid search, then thirds about
  /// each of its local maxima.
  long double maximum(const Function& of) const;

  /// The integral of a continuous function along the ray, by adaptive Simpson.
  long double integral(const Function& of) const;

 private:
  void clip();

  std::array<long double, 8> corner_{};
  std::array<long double, 3> origin_{};
  std::array<long double, 3> direction_{};
  long double t_enter_;
  long double t_exit_;
};

/// Calls check(volume, ray) for random cells of values in [0, 1] and rays that hit them.
void for_random_cells(int trials,
                      const std::function<void(const Volume& cell, const Ray& ray)>& check);

}  // namespace nacre::testing
