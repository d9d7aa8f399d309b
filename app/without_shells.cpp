// What a build without the shell tools says where one with them works.
#include "app/shell_building.h"
#include "app/verify_command.h"
#include "core/error.h"

namespace nacre {
namespace {

[[noreturn]] void refuse() {
  throw Error(ErrorCode::Unsupported,
              "found a build without the shell tools, expected one with CGAL and OpenMesh "
              "(NACRE_BUILD_AUTHORING)");
}

}  // namespace

ShellSet build_shell_set(const ShellFlags& /*flags*/, EmissionVolume /*input*/,
                         Reporter& /*reporter*/, BuildFigures& /*figures*/) {
  refuse();
}

int run_verify(const VerifyFlags& /*flags*/) { refuse(); }

}  // namespace nacre
