// `nacre view`: the viewer's page of a shell set or a volume, served or as a file.
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/page_server.h"
#include "app/served_pictures.h"
#include "app/shell_building.h"
#include "app/thread_limit.h"
#include "app/view_page.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/shell_reader.h"

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves it to programs

namespace nacre {
namespace {

struct ViewFlags {
  CommonFlags common;
  VolumeFlags volume;
  ShellFlags shells;
  std::string output;
  int port = 0;
  bool no_open = false;
};

bool is_shell_file(const std::string& path) {
  return std::filesystem::path(path).extension() == ".glb";
}

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

std::vector<std::byte> built_set(const ShellFlags& flags, EmissionVolume input,
                                 Reporter& reporter) {
  BuildFigures figures;
  const CompressedSet built = build_compressed_set(flags, std::move(input), {}, reporter, figures);
  return assemble_shell_set(built.set, built.shells);
}

/// Building takes a volume away; this one stays for the next level.
EmissionVolume copy_of(const EmissionVolume& input) {
  Volume copy = make_volume(input.volume.dims, input.volume.type);
  std::copy_n(input.volume.samples.data(), input.volume.samples.size(), copy.samples.data());
  copy.slope = input.volume.slope;
  copy.intercept = input.volume.intercept;
  copy.world_from_voxel = input.volume.world_from_voxel;
  return {std::move(copy), input.emission};
}

/// The shell of a level; a draft of it is not simplified.
ServedLevel level_at(ShellFlags flags, const EmissionVolume& input, const LevelRequest& request) {
  const bool is_draft = request.draft && is_simplifying(flags);
  if (is_draft) flags.tolerance = flags.tolerance_mm = 0.0;
  const CompressedSet built = build_one_level(flags, input, request.emission);
  return {assemble_shell_set(built.set, built.shells), is_draft};
}

/// Opens the address where a desktop is; where none is, the address has been said.
void open_on_desktop(const std::string& address) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  std::string program = "xdg-open";
  std::string argument = address;
  std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
  // A browser is no part of this: neither the signals held here nor a Ctrl+C concern it.
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  pid_t child = 0;
  const int failure =
      posix_spawnp(&child, program.c_str(), nullptr, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  if (failure != 0) return;
  std::thread([child] { waitpid(child, nullptr, 0); }).detach();  // no zombie while it is served
}

void write_page(const std::string& output, const std::vector<std::byte>& set, Reporter& reporter) {
  AtomicFile file(output);
  const std::string page = page_with_set(set);
  file.write(page);
  file.commit();
  reporter.say(fmt::format("{} bytes -> {}", page.size(), output));
  reporter.finish({{"bytes", page.size()}});
}

void serve(const ViewFlags& flags, ServedPage served, Reporter& reporter) {
  served.html = page_that_fetches(static_cast<bool>(served.level));
  ServedPictures pictures(served.set);
  served.picture = [&](const PictureRequest& request) { return pictures.draw(request); };
  serve_page(served, flags.port, [&](const std::string& address) {
    reporter.say(fmt::format("{} (Ctrl+C ends it)", address));
    std::fflush(stdout);
    if (!flags.no_open) open_on_desktop(address);
  });
  reporter.finish({{"set_bytes", served.set.size()}});
}

void view_volume(const ViewFlags& flags, Reporter& reporter) {
  check_tolerance_weight(flags.shells);
  EmissionVolume input = read_emission_volume(flags.volume, reporter);
  if (!flags.output.empty()) {
    return write_page(flags.output, built_set(flags.shells, std::move(input), reporter), reporter);
  }
  ServedPage served;
  served.set = built_set(flags.shells, copy_of(input), reporter);
  served.level = [&](const LevelRequest& request) {
    return level_at(flags.shells, input, request);
  };
  serve(flags, std::move(served), reporter);
}

void run_view(const ViewFlags& flags) {
  Reporter reporter(flags.common);
  if (!flags.output.empty() && !is_page_name(flags.output)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found another ending, expected .html", flags.output));
  }
  require_page(flags.output.empty() ? "view" : flags.output);
  if (flags.output.empty()) hold_signals();
  const ThreadLimit limit(flags.common);
  if (!is_shell_file(flags.volume.path)) return view_volume(flags, reporter);
  ServedPage served;
  served.set = checked_set(flags.volume.path);
  if (!flags.output.empty()) return write_page(flags.output, served.set, reporter);
  serve(flags, std::move(served), reporter);
}

}  // namespace

void add_view_verb(CLI::App& app, int& /*status*/) {
  CLI::App* verb = app.add_subcommand(
      "view", "A shell set or a volume in a browser, served on this machine or as a page (.html)");
  verb->footer("Example: nacre view head.glb\n         nacre view head.glb -o head.html");
  auto flags = std::make_shared<ViewFlags>();
  verb->add_option("INPUT", flags->volume.path,
                   "Shell set (.glb), volume file, or folder of a DICOM series")
      ->required();
  verb->add_option("-o,--output", flags->output,
                   "Page, .html, instead of serving: holds the set and works offline");
  verb->add_option("--port", flags->port, "Port on 127.0.0.1 (default: any that is free)")
      ->check(CLI::Range(0, 65535));
  verb->add_flag("--no-open", flags->no_open, "Only say the address, open no browser");
  add_shell_flags(*verb, flags->shells);
  add_compression_flag(*verb, flags->shells);
  add_volume_reading_flags(*verb, flags->volume);
  add_emission_flags(*verb, flags->volume);
  add_common_flags(*verb, flags->common);
  verb->callback([flags] { run_view(*flags); });
}

}  // namespace nacre
