#include "app/picture_output.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <optional>

#include "app/flag_values.h"
#include "core/error.h"
#include "io/picture_file.h"
#include "io/png_picture.h"
#include "render/display.h"

namespace nacre {
namespace {

/// Where "%03d" stands in a name, and its width.
struct NumberField {
  std::size_t begin;
  std::size_t end;
  int width;
};

std::optional<NumberField> number_field(const std::string& pattern) {
  const std::size_t begin = pattern.find('%');
  if (begin == std::string::npos) return std::nullopt;
  std::size_t end = begin + 1;
  int width = 0;
  const auto [stop, failure] =
      std::from_chars(pattern.data() + end, pattern.data() + pattern.size(), width);
  if (failure == std::errc{}) end = static_cast<std::size_t>(stop - pattern.data());
  if (end >= pattern.size() || pattern[end] != 'd' || width > 9) return std::nullopt;
  return NumberField{begin, end + 1, width};
}

DisplayWindow display_window(const Image& image, const PictureFlags& flags) {
  if (flags.display.empty()) return default_display_window(image, picture_mode(flags));
  const auto ends = parse_numbers("--display", flags.display, 2, "LO,HI");
  return {ends[0], ends[1]};
}

}  // namespace

void add_picture_flags(CLI::App& verb, PictureFlags& flags) {
  const std::string group = "Picture";
  verb.add_option("-o,--output", flags.output,
                  "Picture: .png as displayed, .tif as measured (float32: emission for max, "
                  "emission * mm for sum)")
      ->group(group);
  verb.add_option("--mode", flags.mode, "max or sum")->capture_default_str()->group(group);
  verb.add_option(
          "--display", flags.display,
          "LO,HI shown as black and as full brightness in a PNG (default: 0,1 for max; 0 to "
          "the largest pixel for sum)")
      ->group(group);
  verb.add_option("--colormap", flags.color_map, "gray, gray-inverted or hot")
      ->capture_default_str()
      ->group(group);
  verb.add_option("--bits", flags.bits, "Bits a channel in a PNG")
      ->check(CLI::IsMember({8, 16}))
      ->capture_default_str()
      ->group(group);
}

PictureMode picture_mode(const PictureFlags& flags) {
  if (flags.mode == "max") return PictureMode::Max;
  if (flags.mode == "sum") return PictureMode::Sum;
  throw Error(ErrorCode::BadArgument,
              fmt::format("--mode: found '{}', expected max or sum", flags.mode));
}

void check_output(const PictureFlags& flags, const CameraFlags& camera) {
  if (flags.output.empty()) {
    if (camera.turntable > 0) return;
    throw Error(ErrorCode::BadArgument,
                "no output, expected -o with a name ending in .png or .tif");
  }
  picture_format(flags.output);
  if (camera.turntable > 1 && !number_field(flags.output)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found no number in the name, expected %03d for the {} views",
                            flags.output, camera.turntable));
  }
  // Shown once on a single pixel, a bad window or colour map is found before the work.
  const Image pixel = make_image(1, 1);
  display_picture(pixel, display_window(pixel, flags), flags.color_map);
}

std::string numbered_name(const std::string& pattern, int number) {
  const auto field = number_field(pattern);
  if (!field) return pattern;
  return pattern.substr(0, field->begin) + fmt::format("{:0{}}", number, field->width) +
         pattern.substr(field->end);
}

void write_picture(const Image& image, const PictureFlags& flags, const std::string& path) {
  const PictureMode mode = picture_mode(flags);
  if (picture_format(path) == PictureFormat::Tiff) {
    write_measured_picture(image, mode, path);
    return;
  }
  write_png(display_picture(image, display_window(image, flags), flags.color_map), path,
            flags.bits);
}

}  // namespace nacre
