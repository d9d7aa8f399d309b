#include "reference/quartic.h"

namespace nacre {

BernsteinQuartic product(double w0, double w1, const BernsteinCubic& f) noexcept {
  const auto& b = f.b;
  return {{w0 * b[0], 0.25 * (w1 * b[0] + 3.0 * w0 * b[1]), 0.5 * (w1 * b[1] + w0 * b[2]),
           0.25 * (3.0 * w1 * b[2] + w0 * b[3]), w1 * b[3]}};
}

UnitRoots critical_points(const BernsteinQuartic& f) noexcept {
  const auto& b = f.b;
  return crossings({{b[1] - b[0], b[2] - b[1], b[3] - b[2], b[4] - b[3]}}, 0.0);
}

}  // namespace nacre
