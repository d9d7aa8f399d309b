// What a build without the shell tools says where one with them works.
#include <CLI/CLI.hpp>

#include "app/budget_building.h"
#include "app/command.h"
#include "app/error_explaining.h"
#include "app/report_verbs.h"
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

/// A verb that takes anything, to say that it is not here.
void add_missing_verb(CLI::App& app, const char* name, const char* what) {
  CLI::App* verb = app.add_subcommand(name, what);
  verb->allow_extras();
  verb->callback([] { refuse(); });
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

CompressedSet build_within_budget(const BudgetFlags& /*budget*/, const ShellFlags& /*flags*/,
                                  EmissionVolume /*input*/,
                                  const std::filesystem::path& /*scratch_folder*/,
                                  Reporter& /*reporter*/, BuildFigures& /*figures*/) {
  refuse();
}

void check_budget(const std::string& /*budget*/) { refuse(); }

CompressedSet build_one_level(const ShellFlags& /*flags*/, const EmissionVolume& /*input*/,
                              double /*emission*/) {
  refuse();
}

bool is_simplifying(const ShellFlags& /*flags*/) { return false; }

// NOLINTNEXTLINE(performance-unnecessary-value-param): with the shell tools it is moved from.
ExplainedError explain_error(const ExplainFlags& /*flags*/, std::optional<Image> /*picture*/,
                             Reporter& /*reporter*/) {
  refuse();
}

void add_report_verb(CLI::App& app, int& /*status*/) {
  add_missing_verb(app, "report", "Error against run time (not in this build)");
}

void add_tables_verb(CLI::App& app, int& /*status*/) {
  add_missing_verb(app, "tables", "A paper's tables remade (not in this build)");
}
nlohmann::ordered_json certify_set(const VolumeFlags& /*flags*/, const glm::ivec2& /*size*/,
                                   const CompressedSet& /*built*/, Reporter& /*reporter*/,
                                   BuildFigures& /*figures*/) {
  refuse();
}

int run_verify(const VerifyFlags& /*flags*/) { refuse(); }

}  // namespace nacre
