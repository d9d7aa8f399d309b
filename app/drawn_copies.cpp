// Coarse copies in place of shells (docs/decisions/024-coarse-copies.md).
#include "app/drawn_copies.h"

#include <fmt/core.h>

#include "app/certificate_words.h"
#include "core/error.h"

namespace nacre {

namespace {

using nlohmann::ordered_json;

/// Null where the file does not state it.
ordered_json parsed(const std::string& text) {
  return text.empty() ? ordered_json() : ordered_json::parse(text);
}

/// Empty where it is not measured.
std::string error_of(const DrawnCopies& drawn, PictureMode mode, Layers layers) {
  if (mode == PictureMode::Sum) return drawn.sum_error_json;
  if (layers == Layers::Smooth) return {};
  return layers == Layers::Fine ? drawn.max_fine_error_json : drawn.max_error_json;
}

std::string stated_error(const DrawnCopies& drawn, PictureMode mode, Layers layers) {
  if (mode != PictureMode::Max && mode != PictureMode::Sum) {
    return "error of such pictures: not measured";
  }
  return fmt::format(
      "error of {}: {}", mode == PictureMode::Sum ? "sums" : "maxima",
      error_words(parsed(error_of(drawn, mode, layers))).value_or("not stated by the file"));
}

}  // namespace

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
  drawn.max_error_json = info.coarse->max_error_json;
  drawn.max_fine_error_json = info.coarse->max_fine_error_json;
  drawn.sum_error_json = info.coarse->sum_error_json;
  return drawn;
}

void say_copies(const DrawnCopies& drawn, PictureMode mode, Layers layers, Reporter& reporter) {
  reporter.say(fmt::format(
      "draws    coarse copies of {} shells (emission error {:.4g}), and {} shells that have none; "
      "{}",
      drawn.copies, drawn.tolerance, drawn.shells, stated_error(drawn, mode, layers)));
}

ordered_json copies_json(const DrawnCopies& drawn, PictureMode mode, Layers layers) {
  ordered_json json = {
      {"copies", drawn.copies}, {"shells", drawn.shells}, {"tolerance", drawn.tolerance}};
  if (mode == PictureMode::Max) {
    json[layers == Layers::Flat ? "max" : "max_fine"] = parsed(error_of(drawn, mode, layers));
  }
  if (mode == PictureMode::Sum) json["sum"] = parsed(drawn.sum_error_json);
  return json;
}

}  // namespace nacre
