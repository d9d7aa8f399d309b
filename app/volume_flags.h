#pragma once

#include <string>

#include "app/command.h"
#include "extract/emission_volume.h"
#include "io/volume_reader.h"

namespace nacre {

/// How to read a volume and what its values mean, as flags say it.
struct VolumeFlags {
  std::string path;
  std::string raw;     ///< "X,Y,Z,TYPE[,SX,SY,SZ]"
  std::string crop;    ///< "X0,X1,Y0,Y1,Z0,Z1"
  std::string series;  ///< SeriesInstanceUID
  std::string window;  ///< "LO,HI"
  std::string map;     ///< "value:emission,..."
};

/// Adds --raw, --crop and --series.
void add_volume_reading_flags(CLI::App& verb, VolumeFlags& flags);

/// Adds --window and --map.
void add_emission_flags(CLI::App& verb, VolumeFlags& flags);

/// Reads the volume, and tells the reporter what reading found out.
VolumeFile read_volume_of(const VolumeFlags& flags, Reporter& reporter);

/// Reads the volume and finds its emission map: --map, --window, or the default window, which is
/// said.
EmissionVolume read_emission_volume(const VolumeFlags& flags, Reporter& reporter);

/// The same once more, without a word, for a step after one that freed the volume.
/// @param emission  what was found the first time
EmissionVolume read_emission_volume_again(const VolumeFlags& flags, const EmissionMap& emission);

}  // namespace nacre
