// What a build without the shell tools says where one with them works.
#include "app/shell_building.h"
#include "core/error.h"

namespace nacre {

ShellSet build_shell_set(const ShellFlags& /*flags*/, EmissionVolume /*input*/,
                         Reporter& /*reporter*/, BuildFigures& /*figures*/) {
  throw Error(ErrorCode::Unsupported,
              "found a build without the shell tools, expected one with CGAL and OpenMesh "
              "(NACRE_BUILD_AUTHORING)");
}

}  // namespace nacre
