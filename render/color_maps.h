#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>

namespace nacre {

/// Colour maps by name:
///
/// - `gray`, and `gray-inverted`, in which vessels are dark on white as on subtraction films;
/// - `hot` (black, red, yellow, white) and `hot-iron` (DICOM's palette of that name, PS3.6 annex
///   B: red to half way, then green, then blue), of nuclear medicine;
/// - `bone`, gray with a tinge of blue (MATLAB's, as matplotlib has it);
/// - `angio`, of ours: black, dark red, red, ivory, as contrast medium is shown in rendered
/// vessels;
/// - `viridis`, `inferno`, `magma`, `plasma` (S. van der Walt, N. Smith, 2015) and `cividis` (J.
///   Nunez, C. Anderton, R. Renslow, 2018), whose lightness rises evenly: differences are seen
///   where they are, also by the colour-blind and in print. Every third of the 256
///   entries that matplotlib 3.6 has (CC0 for the first four), linear between: to 3/255 of them.
std::span<const std::string_view> color_map_names();

/// The same in one line, "gray, gray-inverted, ... or cividis".
std::string color_map_list();

/// A colour map, ready for use.
class ColorMap {
 public:
  /// @throws Error  BadArgument for a name that is not in `color_map_names`
  explicit ColorMap(std::string_view name);

  /// @param brightness  0 to 1
  /// @return            RGB, 0 to 1
  glm::dvec3 operator()(double brightness) const { return color_(brightness); }

  /// Whether all colours are grays.
  bool is_gray() const noexcept { return gray_; }
  /// Whether nothing is shown as white, and brightness darkens it.
  bool is_inverted() const noexcept { return inverted_; }

 private:
  glm::dvec3 (*color_)(double);
  bool gray_;
  bool inverted_;
};

}  // namespace nacre
