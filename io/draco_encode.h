#pragma once

#include <cstddef>
#include <vector>

#include "core/shell_set.h"
#include "io/draco_guard.h"

namespace nacre {

/// One shell compressed.
struct DracoData {
  std::vector<std::byte> bytes;
  DracoCounts counts;  ///< of what decodes from it
};

/// How triangles are written: along the surface, small, and what this project reads; or one after
/// the other as they are, in a third of the time and six times the bytes.
enum class DracoMethod { Edgebreaker, Sequential };

/// Compresses a mesh whose positions lie on an exact grid; they decode bit for bit.
///
/// @param mesh         gone as soon as Draco has its own copy
/// @param compression  0 (fastest) to 10 (smallest)
/// @throws Error  Unsupported if Draco refuses
DracoData encode_draco(TriangleMesh&& mesh, const QuantizationGrid& grid, int compression,
                       DracoMethod method = DracoMethod::Edgebreaker);

}  // namespace nacre
