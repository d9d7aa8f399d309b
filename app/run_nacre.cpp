#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <string>

#include "app/command.h"
#include "app/failures.h"
#include "app/report_verbs.h"
#include "app/thread_limit.h"

namespace nacre {
namespace {

/// What is wrong, in words of this command where the parser's do not name it.
std::string parse_failure(const CLI::App& app, const CLI::ParseError& error, int argc,
                          char** argv) {
  const bool verb_unknown = argc > 1 && argv[1][0] != '-' && app.get_subcommands().empty();
  if (!verb_unknown) return std::string(error.what()) + " (see nacre -h)";
  std::string verbs;
  for (const CLI::App* verb : app.get_subcommands({})) {
    verbs += (verbs.empty() ? "" : ", ") + verb->get_name();
  }
  return fmt::format("{}: found no such verb, expected {}", argv[1], verbs);
}

/// Parses, which runs the verb's callback. Help and version are no errors.
int parse_and_run(CLI::App& app, int argc, char** argv, const int& status) {
  try {
    app.parse(argc, argv);
    return status;
  } catch (const CLI::Success& wish) {
    return app.exit(wish);
  } catch (const CLI::ParseError& error) {
    return complain("nacre", parse_failure(app, error, argc, argv), kWrongUse);
  }
}

}  // namespace

int run_nacre(int argc, char** argv) {
  return_large_blocks();
  const WorkerThreads workers;
  CLI::App app{
      "Nacre: seeing inside a scanned volume, fast, on any machine.\n"
      "Each verb explains itself: nacre VERB -h",
      "nacre"};
  app.set_version_flag("--version", "nacre " NACRE_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  int status = 0;

  add_phantom_verb(app, status);
  add_build_verb(app, status);
  add_view_verb(app, status);
  add_render_verb(app, status);
  add_reference_verb(app, status);
  add_compare_verb(app, status);
  add_info_verb(app, status);
  add_report_verb(app, status);
  add_tables_verb(app, status);
  add_verify_verb(app, status);
  if (argc == 1) {
    fmt::print("{}", app.help());
    return kWrongUse;
  }
  return guarded("nacre", [&] { return parse_and_run(app, argc, argv, status); });
}

}  // namespace nacre
