#include "app/picture_output.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <optional>

#include "app/flag_values.h"
#include "core/error.h"
#include "io/picture_file.h"
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

ToolBlend tool_blend(const PictureFlags& flags) {
  if (flags.tool_blend == "max") return ToolBlend::Max;
  if (flags.tool_blend == "over") return ToolBlend::Over;
  throw Error(ErrorCode::BadArgument,
              fmt::format("--tool-blend: found '{}', expected max or over", flags.tool_blend));
}

/// A turntable's views need names of their own, or a file that holds them all.
void check_names(const std::string& output, int views) {
  const bool animated = picture_format(output) == PictureFormat::Apng;
  const bool numbered = number_field(output).has_value();
  if (animated && numbered) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found a number in the name, expected none: one .apng holds all "
                            "views",
                            output));
  }
  if (views > 1 && !animated && !numbered) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found no number in the name, expected %03d for the {} views, or "
                            "an .apng",
                            output, views));
  }
}

}  // namespace

void add_picture_flags(CLI::App& verb, PictureFlags& flags) {
  const std::string group = "Picture";
  verb.add_option("-o,--output", flags.output,
                  "Picture: .png as displayed, .tif as measured (float32: emission for max, "
                  "emission * mm for sum; without tools). With --turntable: name%03d.png, or one "
                  "animated .apng")
      ->group(group);
  verb.add_option("--mode", flags.mode,
                  "max (the largest emission on each ray), sum (the emission integral), count "
                  "(each shell crossed adds its brightness) or iso (lit shells)")
      ->capture_default_str()
      ->group(group);
  verb.add_option(
          "--display", flags.display,
          "LO,HI shown as black and as full brightness in a PNG (default: 0,1 for max and iso; 0 "
          "to the largest pixel, of all views, for sum and count)")
      ->group(group);
  verb.add_option("--colormap", flags.color_map, color_map_list())
      ->capture_default_str()
      ->group(group);
  verb.add_option("--tool-blend", flags.tool_blend,
                  "How a PNG joins tools and what is seen in front of them: max (the brighter of "
                  "each channel; added for sum and count) or over (what is in front replaces them)")
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
  if (flags.mode == "count") return PictureMode::Count;
  if (flags.mode == "iso") return PictureMode::Iso;
  throw Error(ErrorCode::BadArgument,
              fmt::format("--mode: found '{}', expected max, sum, count or iso", flags.mode));
}

std::optional<DisplayWindow> window_known_before(const PictureFlags& flags) {
  const PictureMode mode = picture_mode(flags);
  if (!flags.display.empty()) {
    const auto ends = parse_numbers("--display", flags.display, 2, "LO,HI");
    return DisplayWindow{ends[0], ends[1]};
  }
  if (mode == PictureMode::Sum || mode == PictureMode::Count) return std::nullopt;
  return default_display_window(0.0F, mode);
}

DisplayOptions display_options(const PictureFlags& flags, const DisplayWindow& window) {
  return {.window = window,
          .color_map = flags.color_map,
          .mode = picture_mode(flags),
          .blend = tool_blend(flags)};
}

void check_output(const PictureFlags& flags, const CameraFlags& camera) {
  // Shown once on a single pixel, a bad window or colour map is found before the work.
  const DisplayWindow window = window_known_before(flags).value_or(DisplayWindow{});
  display_picture(Picture{make_image(1, 1), std::nullopt}, display_options(flags, window));
  if (!flags.output.empty()) {
    check_names(flags.output, camera.turntable);
  } else if (camera.turntable == 0) {
    throw Error(ErrorCode::BadArgument,
                "no output, expected -o with a name ending in .png or .tif");
  }
}

std::string numbered_name(const std::string& pattern, int number) {
  const auto field = number_field(pattern);
  if (!field) return pattern;
  return pattern.substr(0, field->begin) + fmt::format("{:0{}}", number, field->width) +
         pattern.substr(field->end);
}

}  // namespace nacre
