// `nacre render`: a picture of a volume.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/exact_command.h"

namespace nacre {

void add_render_verb(CLI::App& app, int& /*status*/) {
  CLI::App* verb = app.add_subcommand("render", "A picture of a volume");
  verb->footer("Example: nacre render head.nii.gz --window 20,230 --azimuth 30 -o head.png");
  auto flags = std::make_shared<ExactFlags>();
  auto method = std::make_shared<std::string>("auto");
  verb->add_option("INPUT", flags->volume.path, "Volume file, or folder of a DICOM series")
      ->required();
  verb->add_option("--method", *method, "How a volume is shown: exact walks its rays")
      ->check(CLI::IsMember({"auto", "exact"}))
      ->capture_default_str();
  add_exact_flags(*verb, *flags);
  // `method` has one meaning so far; the parser still writes to it, so it must live on.
  verb->callback([flags, method] { run_exact(*flags); });
}

}  // namespace nacre
