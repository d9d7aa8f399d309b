#include "report/picture_error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace nacre {
namespace {

void require_same_size(const Image& picture, const Image& truth) {
  if (picture.width != truth.width || picture.height != truth.height) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("pictures: found {} x {} and {} x {} pixels, expected one size",
                            picture.width, picture.height, truth.width, truth.height));
  }
}

struct ErrorSums {
  std::size_t pixels = 0;
  double squares = 0.0;
  double sum = 0.0;
  double largest = 0.0;

  void add(double error) {
    ++pixels;
    squares += error * error;
    sum += error;
    largest = std::max(largest, std::abs(error));
  }

  PictureError result(double peak) const {
    PictureError error;
    error.pixels = pixels;
    if (pixels > 0) {
      error.rmse = std::sqrt(squares / static_cast<double>(pixels));
      error.bias = sum / static_cast<double>(pixels);
    }
    error.psnr_db = 20.0 * std::log10(peak / error.rmse);
    error.max_error = largest;
    return error;
  }
};

}  // namespace

PictureComparison compare_pictures(const Image& picture, const Image& truth, double peak) {
  require_same_size(picture, truth);
  if (!(peak > 0.0) || !std::isfinite(peak)) {
    throw Error(ErrorCode::BadArgument,
                fmt::format("peak: found {}, expected a positive number", peak));
  }
  PictureComparison comparison;
  comparison.peak = peak;
  ErrorSums all;
  ErrorSums lit;
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const double error = static_cast<double>(picture.at(x, y)) - truth.at(x, y);
      if (std::abs(error) > all.largest) {
        comparison.worst_x = x;
        comparison.worst_y = y;
      }
      all.add(error);
      if (truth.at(x, y) > 0.0f) lit.add(error);
    }
  }
  comparison.all = all.result(peak);
  comparison.lit = lit.result(peak);
  return comparison;
}

Image difference(const Image& picture, const Image& truth) {
  require_same_size(picture, truth);
  Image result = make_image(truth.width, truth.height);
  std::transform(picture.pixels.begin(), picture.pixels.end(), truth.pixels.begin(),
                 result.pixels.begin(), [](float a, float b) { return a - b; });
  return result;
}

DisplayImage difference_picture(const Image& difference, double gain) {
  DisplayImage picture{difference.width, difference.height, 3, {}};
  picture.pixels.reserve(3 * difference.pixels.size());
  for (const float error : difference.pixels) {
    const double strength = std::clamp(gain * static_cast<double>(error), -1.0, 1.0);
    const auto full = static_cast<std::uint16_t>(std::lround(65535.0 * std::abs(strength)));
    // Half green beside blue: pure blue is too dark to be seen.
    const auto half = static_cast<std::uint16_t>(full / 2);
    picture.pixels.push_back(strength > 0.0 ? full : 0);
    picture.pixels.push_back(strength < 0.0 ? half : static_cast<std::uint16_t>(half / 3));
    picture.pixels.push_back(strength < 0.0 ? full : 0);
  }
  return picture;
}

}  // namespace nacre
