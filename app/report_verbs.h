#pragma once

namespace CLI {
class App;
}

namespace nacre {

// The verbs that measure, which a build without the shell tools only names; as those of
// app/command.h.
void add_report_verb(CLI::App& app, int& status);
void add_tables_verb(CLI::App& app, int& status);

}  // namespace nacre
