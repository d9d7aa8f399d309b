// What a build without the shell tools says where one with them works.
#include "app/error_explaining.h"
#include "app/set_certificate.h"
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

CompressedSet build_compressed_set(const ShellFlags& /*flags*/, EmissionVolume /*input*/,
                                   const std::filesystem::path& /*scratch_folder*/,
                                   Reporter& /*reporter*/, BuildFigures& /*figures*/) {
  refuse();
}

ExplainedError explain_error(const ExplainFlags& /*flags*/, std::optional<Image> /*picture*/,
                             Reporter& /*reporter*/) {
  refuse();
}

nlohmann::ordered_json certify_set(const VolumeFlags& /*flags*/, const glm::ivec2& /*size*/,
                                   const CompressedSet& /*built*/, Reporter& /*reporter*/,
                                   BuildFigures& /*figures*/) {
  refuse();
}

int run_verify(const VerifyFlags& /*flags*/) { refuse(); }

}  // namespace nacre
