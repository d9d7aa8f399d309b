#pragma once

#include <cstdint>

#include "core/volume.h"

namespace nacre {

/// Recognises a volume's stored samples, whatever file they came in.
///
/// The bytes of the samples (little-endian, x fastest) are cut into blocks of 2^20, the last one
/// shorter; the checksum is the XXH64 of the blocks' XXH64s, eight little-endian bytes each, seeded
/// with the number of bytes. Blocks are read in parallel.
std::uint64_t voxel_checksum(const Volume& volume);

}  // namespace nacre
