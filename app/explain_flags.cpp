#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "app/error_explaining.h"

namespace nacre {
namespace {

void add_scene(CLI::App& verb, ExplainFlags& flags) {
  const std::string group = "Picture";
  verb.add_option("--mode", flags.scene.picture.mode, "max, sum, count or iso")
      ->capture_default_str()
      ->group(group);
  add_scene_flags(verb, flags.scene.scene);
  add_camera_flags(verb, flags.scene.camera);
  add_draw_flags(verb, flags.draw);
  verb.remove_option(verb.get_option("--layers"));
  flags.draw.layers = "flat";  // what levels cost is one of the causes
  add_volume_reading_flags(verb, flags.scene.volume);
  verb.add_option("--map", flags.scene.volume.map,
                  "VALUE:EMISSION,... that the set was built with, if it rises and falls")
      ->group("Volume");
}

}  // namespace

void add_explain_flags(CLI::App& verb, ExplainFlags& flags) {
  const std::string group = "Causes of an error";
  auto* explain =
      verb.add_option(
              "--explain-error", flags.set,
              "Shell set (.glb): split the error of its picture against the exact one of "
              "--volume into levels, contouring, vertex quantisation, simplification and "
              "rasterisation. PICTURE, if given, is what was drawn, with flat layers (--size "
              "its size); else it is drawn now")
          ->group(group);
  auto* volume = verb.add_option("--volume", flags.scene.volume.path,
                                 "The volume that the set was built from, read as it was then")
                     ->group(group);
  explain->needs(volume);
  volume->needs(explain);
  const std::vector<CLI::Option*> before = verb.get_options();
  add_scene(verb, flags);
  for (CLI::Option* option : verb.get_options()) {
    if (std::find(before.begin(), before.end(), option) == before.end()) option->needs(explain);
  }
}

}  // namespace nacre
