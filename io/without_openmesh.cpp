// The tool reader in a build without OpenMesh.
#include <fmt/core.h>

#include "core/error.h"
#include "io/tool_reader.h"

namespace nacre {

Tool read_tool(const std::filesystem::path& path) {
  throw Error(ErrorCode::Unsupported,
              fmt::format("{}: found a build without the tool reader, expected one with OpenMesh "
                          "(NACRE_BUILD_AUTHORING)",
                          path.string()));
}

}  // namespace nacre
