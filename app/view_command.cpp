// `nacre view`: the viewer's page of a shell set.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/view_page.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/shell_reader.h"

namespace nacre {
namespace {

struct ViewFlags {
  CommonFlags common;
  std::string input;
  std::string output;
};

/// The bytes of a shell file that has been looked through.
std::vector<std::byte> checked_set(const std::string& path) {
  const std::size_t size = read_shell_file_info(path).file_bytes;
  std::vector<std::byte> bytes(size);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!file) throw Error(ErrorCode::BadFile, fmt::format("{}: cannot be read", path));
  parse_shell_file_info(bytes, path);
  return bytes;
}

void run_view(const ViewFlags& flags) {
  Reporter reporter(flags.common);
  if (!is_page_name(flags.output)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found another ending, expected .html", flags.output));
  }
  require_page(flags.output);
  AtomicFile file(flags.output);
  const std::string page = page_with_set(checked_set(flags.input));
  file.write(page);
  file.commit();
  reporter.say(fmt::format("{} bytes -> {}", page.size(), flags.output));
  reporter.finish({{"bytes", page.size()}});
}

}  // namespace

void add_view_verb(CLI::App& app, int& /*status*/) {
  CLI::App* verb = app.add_subcommand("view", "The viewer's page of a shell set (.html)");
  verb->footer("Example: nacre view head.glb -o head.html");
  auto flags = std::make_shared<ViewFlags>();
  verb->add_option("INPUT", flags->input, "Shell set (.glb)")->required();
  verb->add_option("-o,--output", flags->output,
                   "Page, .html: holds the set and shows it in a browser, offline")
      ->required();
  add_common_flags(*verb, flags->common);
  verb->callback([flags] { run_view(*flags); });
}

}  // namespace nacre
