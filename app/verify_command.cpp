// `nacre verify`: does a file keep what shells promise?
#include "app/verify_command.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace nacre {

void add_verify_verb(CLI::App& app, int& status) {
  CLI::App* verb = app.add_subcommand(
      "verify",
      "Checks the surfaces of a .glb file: closed, oriented, manifold, without triangles that are "
      "degenerate, on their grid; counts self-intersections and crossings of neighbours; against "
      "the volume: emission error, distance from the shells made anew. Exits 1 if a promise is "
      "broken");
  verb->footer("Example: nacre verify head.glb --volume head.nii.gz --json -");
  auto flags = std::make_shared<VerifyFlags>();
  verb->add_option("FILE", flags->file, "Shell set, or any .glb file with triangle meshes")
      ->required();
  verb->add_option("--volume", flags->volume.path,
                   "The volume it was made from: file, or folder of a DICOM series");
  add_volume_reading_flags(*verb, flags->volume);
  verb->add_option("--map", flags->volume.map,
                   "VALUE:EMISSION,...: the map it was made with, if that falls anywhere")
      ->group("Volume");
  add_common_flags(*verb, flags->common);
  verb->callback([flags, &status] { status = run_verify(*flags); });
}

}  // namespace nacre
