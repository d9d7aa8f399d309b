#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <string>

#include "app/command.h"
#include "app/report_verbs.h"
#include "core/error.h"

namespace nacre {
namespace {

constexpr int kWrongUse = 2;
constexpr int kBadInput = 3;
constexpr int kCannotHere = 4;

int exit_status(ErrorCode code) {
  switch (code) {
    case ErrorCode::BadArgument: return kWrongUse;
    case ErrorCode::BadFile: return kBadInput;
    case ErrorCode::Unsupported: return kCannotHere;
  }
  return kCannotHere;
}

int complain(const std::string& message, int status) {
  // Error flattens messages of many lines.
  fmt::print(stderr, "nacre: {}\n", Error(ErrorCode::BadArgument, message).what());
  return status;
}

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
    return complain(parse_failure(app, error, argc, argv), kWrongUse);
  }
}

}  // namespace

int run_nacre(int argc, char** argv) {
  return_large_blocks();
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
  try {
    return parse_and_run(app, argc, argv, status);
  } catch (const Error& error) {
    return complain(error.what(), exit_status(error.code()));
  } catch (const std::bad_alloc&) {
    return complain("not enough memory", kCannotHere);
  } catch (const std::exception& error) {
    return complain(error.what(), kCannotHere);
  }
}

}  // namespace nacre
