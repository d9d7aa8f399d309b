#pragma once

#include <cstddef>
#include <span>

#include "core/triangle_mesh.h"
#include "io/draco_guard.h"

namespace nacre {

/// Decodes one shell's compressed data. Nothing of it is trusted: see `draco_objection`.
///
/// @throws Error  BadFile, with a message to follow a subject: "found ..., expected ..."
TriangleMesh decode_draco(std::span<const std::byte> data, const DracoCounts& expected);

}  // namespace nacre
