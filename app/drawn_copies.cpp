// Coarse copies in place of shells (docs/decisions/024-coarse-copies.md).
#include "app/drawn_copies.h"

#include <fmt/core.h>

#include "core/error.h"

namespace nacre {

using nlohmann::ordered_json;

DrawnCopies take_copies(const std::string& path, ShellFileInfo& info) {
  DrawnCopies drawn;
  for (std::size_t k = 0; info.coarse && k < info.levels.size(); ++k) {
    if (info.coarse->levels[k]) {
      info.levels[k] = *info.coarse->levels[k];
      ++drawn.copies;
    } else if (info.levels[k].triangles > 0) {
      ++drawn.shells;
    }
  }
  if (drawn.copies == 0) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("{}: found no coarse copies for --coarse, expected a shell set of "
                            "nacre build --coarse",
                            path));
  }
  drawn.tolerance = info.coarse->tolerance;
  drawn.error_json = info.coarse->error_json;
  return drawn;
}

void say_copies(const DrawnCopies& drawn, Reporter& reporter) {
  reporter.say(fmt::format(
      "draws    coarse copies of {} shells (emission error {:.4g}), and {} shells that have none; "
      "error of maxima: {}",
      drawn.copies, drawn.tolerance, drawn.shells,
      drawn.error_json.empty() ? "not stated by the file" : drawn.error_json));
}

ordered_json copies_json(const DrawnCopies& drawn) {
  ordered_json json = {
      {"copies", drawn.copies}, {"shells", drawn.shells}, {"tolerance", drawn.tolerance}};
  json["max"] = drawn.error_json.empty() ? ordered_json() : ordered_json::parse(drawn.error_json);
  return json;
}

}  // namespace nacre
