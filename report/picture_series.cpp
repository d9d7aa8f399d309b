#include "report/picture_series.h"

#include <fmt/core.h>

#include "core/error.h"

namespace nacre {

Image stacked(std::span<const Image> pictures) {
  if (pictures.empty()) {
    throw Error(ErrorCode::BadArgument, "pictures: found none, expected at least one");
  }
  Image result;
  result.width = pictures.front().width;
  for (const Image& picture : pictures) {
    if (picture.width != result.width || picture.height != pictures.front().height) {
      throw Error(
          ErrorCode::BadArgument,
          fmt::format("pictures: found {} x {} and {} x {} pixels, expected one size", result.width,
                      pictures.front().height, picture.width, picture.height));
    }
    result.height += picture.height;
    result.pixels.insert(result.pixels.end(), picture.pixels.begin(), picture.pixels.end());
  }
  return result;
}

}  // namespace nacre
