#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "render/render_options.h"

namespace nacre::testing {

inline constexpr std::array<DepthFormat, 3> kFormats{DepthFormat::D16, DepthFormat::D24,
                                                     DepthFormat::D32F};

/// What a depth buffer gives back of what is written to it.
inline double stored(DepthFormat format, double depth) {
  if (format == DepthFormat::D32F) return static_cast<double>(static_cast<float>(depth));
  const double steps = format == DepthFormat::D16 ? 65535.0 : 16777215.0;
  return std::round(std::clamp(depth, 0.0, 1.0) * steps) / steps;
}

/// The same through OpenGL's usual clip range: the vertex stage writes 2 d - 1 as a float, which is
/// then halved and moved back.
inline double stored_by_default(DepthFormat format, double depth) {
  const auto clip = static_cast<float>(2.0 * depth - 1.0);
  return stored(format, static_cast<double>(0.5F * clip + 0.5F));
}

inline std::string format_words(DepthFormat format) {
  return "depth buffer " + std::string(name(format));
}

/// Largest relative error where emission itself is the depth, in OpenGL's usual clip range.
inline double emission_as_depth_error(const std::vector<double>& representatives,
                                      DepthFormat format) {
  double largest = 0.0;
  for (const double truth : representatives) {
    largest = std::max(largest, std::abs(stored_by_default(format, truth) - truth) / truth);
  }
  return largest;
}

}  // namespace nacre::testing
