#include "app/volume_flags.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "app/flag_values.h"
#include "core/error.h"
#include "extract/default_window.h"

namespace nacre {
namespace {

/// "v:phi,v:phi,..." as knots.
std::vector<EmissionKnot> parse_map(const std::string& text) {
  std::vector<EmissionKnot> knots;
  for (const std::string& part : split(text, ',')) {
    const auto colon = part.find(':');
    if (colon == std::string::npos) {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("--map: found '{}', expected VALUE:EMISSION,...", text));
    }
    const auto number = [&](const std::string& word) {
      return parse_numbers("--map", word, 1, "VALUE:EMISSION,...").front();
    };
    knots.push_back({number(part.substr(0, colon)), number(part.substr(colon + 1))});
  }
  return knots;
}

VolumeReadOptions read_options(const VolumeFlags& flags) {
  VolumeReadOptions options;
  if (!flags.raw.empty()) options.raw = parse_raw_header(flags.raw);
  if (!flags.crop.empty()) options.crop = parse_voxel_crop(flags.crop);
  options.dicom_series = flags.series;
  return options;
}

void tell(const VolumeReadReport& report, const std::string& path, Reporter& reporter) {
  for (const std::string& warning : report.warnings) {
    reporter.warn(fmt::format("{}: {}", path, warning));
  }
  const std::size_t infinite = report.positive_infinity_count + report.negative_infinity_count;
  if (report.nan_count + infinite > 0) {
    reporter.warn(fmt::format(
        "{}: found {} NaN and {} infinite samples; NaN became the lowest finite value, infinities "
        "the extreme finite ones",
        path, report.nan_count, infinite));
  }
}

}  // namespace

void add_volume_reading_flags(CLI::App& verb, VolumeFlags& flags) {
  const std::string group = "Volume";
  verb.add_option("--raw", flags.raw,
                  "X,Y,Z,TYPE[,SX,SY,SZ]: the file is bare samples (u8 i8 u16 i16 u32 i32 f32 f64, "
                  "'be' added for big endian), spacing in mm")
      ->group(group);
  verb.add_option("--crop", flags.crop, "X0,X1,Y0,Y1,Z0,Z1: voxels to keep, both ends included")
      ->group(group);
  verb.add_option("--series", flags.series, "SeriesInstanceUID, where a folder holds several")
      ->group(group);
}

void add_emission_flags(CLI::App& verb, VolumeFlags& flags) {
  const std::string group = "Volume";
  auto* window = verb.add_option("--window", flags.window,
                                 "LO,HI: values shown as emission 0 and 1 (default: chosen, said)")
                     ->group(group);
  verb.add_option(
          "--map", flags.map,
          "VALUE:EMISSION,...: emission between these knots is linear, beyond them constant")
      ->group(group)
      ->excludes(window);
}

VolumeFile read_volume_of(const VolumeFlags& flags, Reporter& reporter) {
  VolumeFile file = read_volume(flags.path, read_options(flags));
  tell(file.report, flags.path, reporter);
  return file;
}

EmissionVolume read_emission_volume(const VolumeFlags& flags, Reporter& reporter) {
  // Flags are checked before a long read.
  std::vector<EmissionKnot> knots;
  if (!flags.map.empty()) knots = parse_map(flags.map);
  std::vector<double> window;
  if (!flags.window.empty()) window = parse_numbers("--window", flags.window, 2, "LO,HI");
  if (!window.empty()) EmissionMap::window(window[0], window[1]);

  Volume volume = read_volume_of(flags, reporter).volume;
  if (!knots.empty()) return map_volume(std::move(volume), std::move(knots));
  if (window.empty()) {
    const Window chosen = default_window(volume);
    window = {chosen.lo, chosen.hi};
    reporter.say(fmt::format("window {:.6g},{:.6g} (chosen; --window LO,HI overrides)", chosen.lo,
                             chosen.hi));
  }
  return {std::move(volume), EmissionMap::window(window[0], window[1])};
}

EmissionVolume read_emission_volume_again(const VolumeFlags& flags, const EmissionMap& emission) {
  Volume volume = read_volume(flags.path, read_options(flags)).volume;
  if (!flags.map.empty()) return map_volume(std::move(volume), parse_map(flags.map));
  return {std::move(volume), emission};
}

}  // namespace nacre
