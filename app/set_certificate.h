#pragma once

#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "app/command.h"
#include "app/shell_building.h"
#include "app/volume_flags.h"

namespace nacre {

class Certifier;

/// Measures a set's error as it will decode (`Certifier`), against its volume, which is read once
/// more: building freed it.
///
/// Some shells are in memory at a time, beside the volume and the pictures.
///
/// @param size    of each picture, pixels
/// @return        what the file states (docs/shell_file.md)
/// @throws Error  BadFile if the volume is not the one that the set was made from any more;
///                Unsupported in a build without the shell tools
nlohmann::ordered_json certify_set(const VolumeFlags& flags, const glm::ivec2& size,
                                   const CompressedSet& built, Reporter& reporter,
                                   BuildFigures& figures);

/// A certificate that is at least as long as any of pictures of that size: what a file is sure to
/// hold.
std::string longest_certificate(const glm::ivec2& size);

/// Gives a measurement the set's shells, decoded, some at a time.
void add_shells(const CompressedSet& built, const ProgressCallback& callback, Certifier& certifier);

}  // namespace nacre
