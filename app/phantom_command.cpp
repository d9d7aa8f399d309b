// `nacre phantom`: a volume made in code.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "app/command.h"
#include "app/flag_values.h"
#include "app/thread_limit.h"
#include "core/error.h"
#include "core/volume_geometry.h"
#include "datasets/phantom.h"
#include "io/volume_writer.h"

namespace nacre {
namespace {

struct PhantomFlags {
  CommonFlags common;
  std::string name;
  std::string output;
  std::string size;
  std::string corners;
  std::uint64_t seed = 1;
  std::optional<double> noise;
  bool list = false;
};

void list_phantoms() {
  for (const PhantomInfo& info : phantom_list()) {
    fmt::print(
        "{:<13} {:<4} {:>12}  window {:g},{:g}   {}\n", info.name, name(info.type),
        fmt::format("{}x{}x{}", info.default_size.x, info.default_size.y, info.default_size.z),
        info.window_lo, info.window_hi, info.what);
  }
}

PhantomOptions phantom_options(const PhantomFlags& flags) {
  PhantomOptions options;
  options.seed = flags.seed;
  options.noise = flags.noise;
  if (!flags.size.empty()) {
    const auto size = parse_integers("--size", flags.size, 3, "X,Y,Z in samples");
    options.size = glm::i64vec3(size[0], size[1], size[2]);
  }
  if (!flags.corners.empty()) {
    const auto values = parse_numbers("--corners", flags.corners, 8, "8 numbers, x fastest");
    options.corners.emplace();
    std::copy(values.begin(), values.end(), options.corners->begin());
  }
  return options;
}

void run_phantom(const PhantomFlags& flags) {
  if (flags.list) {
    list_phantoms();
    return;
  }
  if (flags.name.empty() || flags.output.empty()) {
    throw Error(ErrorCode::BadArgument,
                "phantom: found no name or no -o, expected NAME -o FILE (see --list)");
  }
  Reporter reporter(flags.common);
  const ThreadLimit limit(flags.common);
  require_volume_name(flags.output);
  Stopwatch watch;
  const Volume volume = make_phantom(flags.name, phantom_options(flags), reporter.progress());
  const double making = watch.lap();
  write_volume(volume, flags.output);
  const double writing = watch.lap();
  const auto info = std::find_if(phantom_list().begin(), phantom_list().end(),
                                 [&](const PhantomInfo& card) { return card.name == flags.name; });
  reporter.say(fmt::format("{}: {} x {} x {} samples of {}, window {:g},{:g} -> {}", flags.name,
                           volume.dims.x, volume.dims.y, volume.dims.z, name(volume.type),
                           info->window_lo, info->window_hi, flags.output));
  const glm::dvec3 spacing = spacing_mm(volume.world_from_voxel);
  reporter.finish({{"phantom", flags.name},
                   {"seed", flags.seed},
                   {"volume",
                    {{"dims", {volume.dims.x, volume.dims.y, volume.dims.z}},
                     {"spacing_mm", {spacing.x, spacing.y, spacing.z}},
                     {"type", name(volume.type)}}},
                   {"window", {info->window_lo, info->window_hi}},
                   {"seconds", {{"make", making}, {"write", writing}}},
                   {"peak_rss_bytes", peak_rss_bytes()}});
}

}  // namespace

void add_phantom_verb(CLI::App& app, int& /*status*/) {
  CLI::App* verb = app.add_subcommand("phantom", "Write a synthetic volume");
  verb->footer("Example: nacre phantom angiogram -o head.nrrd --seed 7");
  auto flags = std::make_shared<PhantomFlags>();
  verb->add_option("NAME", flags->name, "Which one; --list names them");
  verb->add_option("-o,--output", flags->output, "Volume file: .nrrd, .mha, .mhd, .nii or .nii.gz");
  verb->add_flag("--list", flags->list, "Name the phantoms");
  verb->add_option("--size", flags->size, "X,Y,Z in samples");
  verb->add_option("--seed", flags->seed, "Of all that is random in it")->capture_default_str();
  verb->add_option("--noise", flags->noise, "Standard deviation of the noise, in the values' unit");
  verb->add_option("--corners", flags->corners, "cell: its 8 corner values, x fastest");
  add_common_flags(*verb, flags->common);
  verb->callback([flags] { run_phantom(*flags); });
}

}  // namespace nacre
