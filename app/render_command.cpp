// `nacre render`: a picture of a shell set or of a volume.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/exact_command.h"
#include "app/shell_render.h"
#include "casting/sample_kernel.h"
#include "core/error.h"

namespace nacre {
namespace {

constexpr int kSamples = 2;  // a voxel

struct RenderFlags {
  ExactFlags exact;
  DrawFlags draw;
  ShellFlags shells;
  std::string method = "auto";
  std::optional<int> samples;
  bool list_backends = false;
};

/// Whether the mode is one of shells only, which no exact walk has.
bool shows_shells(const RenderFlags& flags) {
  const PictureMode mode = picture_mode(flags.exact.picture);
  return mode == PictureMode::Count || mode == PictureMode::Iso;
}

void run_render(const RenderFlags& flags) {
  if (flags.list_backends) {
    say_backends();
    return;
  }
  if (flags.samples && flags.method != "sampled") {
    throw Error(
        ErrorCode::BadArgument,
        fmt::format("--samples: found --method {}, expected --method sampled", flags.method));
  }
  const std::string& input = flags.exact.volume.path;
  if (input.empty()) {
    throw Error(ErrorCode::BadArgument, "render: found no INPUT, expected a shell set or a volume");
  }
  if (std::filesystem::path(input).extension() == ".glb") {
    if (flags.method == "exact" || flags.method == "sampled") {
      throw Error(ErrorCode::BadArgument,
                  fmt::format("{}: found a shell set, expected a volume for --method {}", input,
                              flags.method));
    }
    run_shell_file(flags.exact, flags.draw);
  } else if (flags.draw.coarse) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found no .glb file, expected a shell set for --coarse", input));
  } else if (flags.method == "shells" || (flags.method == "auto" && shows_shells(flags))) {
    run_shells_of_volume(flags.exact, flags.draw, flags.shells);
  } else {
    // For one picture of a volume at hand the exact walk is done before shells are built.
    ExactFlags exact = flags.exact;
    exact.levels = flags.shells;
    if (flags.method == "sampled") exact.samples = flags.samples.value_or(kSamples);
    run_exact(exact);
  }
}

}  // namespace

void add_render_verb(CLI::App& app, int& /*status*/) {
  CLI::App* verb = app.add_subcommand("render", "A picture of a shell set or of a volume");
  verb->footer("Example: nacre render head.glb --azimuth 30 -o head.png");
  auto flags = std::make_shared<RenderFlags>();
  verb->add_option("INPUT", flags->exact.volume.path,
                   "Shell set (.glb), volume file, or folder of a DICOM series");
  verb->add_option("--method", flags->method,
                   "How a volume is shown: shells built in memory, the exact walk of its rays, or "
                   "samples along them for max (auto: exact for max and sum, shells for count and "
                   "iso)")
      ->check(CLI::IsMember({"auto", "shells", "exact", "sampled"}))
      ->capture_default_str();
  verb->add_option(
          "--samples", flags->samples,
          fmt::format("Samples a voxel along a ray for --method sampled (default: {})", kSamples))
      ->check(CLI::Range(1, kMostSamplesPerCell));
  verb->add_flag("--list-backends", flags->list_backends,
                 "Name the OpenGL contexts of this machine");
  add_draw_flags(*verb, flags->draw);
  verb->add_flag("--coarse", flags->draw.coarse,
                 "Draw the coarse copies of a set's shells, where the file has them")
      ->group("Drawing shells");
  add_shell_flags(*verb, flags->shells);
  add_exact_flags(*verb, flags->exact);
  verb->callback([flags] { run_render(*flags); });
}

}  // namespace nacre
