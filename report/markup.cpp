#include "report/markup.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "io/png_picture.h"

namespace nacre {
namespace {

/// Mean of a channel over a block of size^2 pixels, or of what the picture has of it.
std::uint16_t block_mean(const DisplayImage& picture, int x, int y, int channel, int size) {
  const int right = std::min((x + 1) * size, picture.width);
  const int bottom = std::min((y + 1) * size, picture.height);
  std::uint64_t sum = 0;
  for (int j = y * size; j < bottom; ++j) {
    for (int i = x * size; i < right; ++i) {
      sum +=
          picture
              .pixels[static_cast<std::size_t>(channel) +
                      static_cast<std::size_t>(picture.channels) *
                          (static_cast<std::size_t>(i) +
                           static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(j))];
    }
  }
  const auto pixels =
      static_cast<std::uint64_t>(right - x * size) * static_cast<std::uint64_t>(bottom - y * size);
  return static_cast<std::uint16_t>((sum + pixels / 2) / pixels);
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      case '\'': result += "&#39;"; break;
      default: result += c;
    }
  }
  return result;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool there = i + k < bytes.size();
      group = group << 8U | (there ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    const std::size_t digits = std::min<std::size_t>(3, bytes.size() - i) + 1;
    for (std::size_t k = 0; k < 4; ++k) {
      text += k < digits ? kDigits[group >> (18U - 6U * k) & 63U] : '=';
    }
  }
  return text;
}

std::string data_uri(const DisplayImage& picture) {
  return "data:image/png;base64," + base64(encode_png(picture));
}

DisplayImage thumbnail(const DisplayImage& picture, int side) {
  const int size = std::max(1, (std::max(picture.width, picture.height) + side - 1) / side);
  DisplayImage small{
      std::max(1, picture.width / size), std::max(1, picture.height / size), picture.channels, {}};
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      for (int c = 0; c < small.channels; ++c) {
        small.pixels.push_back(block_mean(picture, x, y, c, size));
      }
    }
  }
  return small;
}

PictureCrop lit_part(const Image& image, double peak) {
  const auto least = static_cast<float>(0.01 * peak);
  int left = image.width;
  int top = image.height;
  int right = -1;
  int bottom = -1;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y) <= least) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  if (right < 0) return {0, 0, image.width, image.height};
  const int margin = std::max(image.width, image.height) / 64 + 1;
  left = std::max(0, left - margin);
  top = std::max(0, top - margin);
  right = std::min(image.width - 1, right + margin);
  bottom = std::min(image.height - 1, bottom + margin);
  return {left, top, right - left + 1, bottom - top + 1};
}

DisplayImage cropped(const DisplayImage& picture, const PictureCrop& part) {
  DisplayImage result{part.width, part.height, picture.channels, {}};
  for (int y = part.y; y < part.y + part.height; ++y) {
    const auto row =
        picture.pixels.begin() + static_cast<std::ptrdiff_t>(picture.channels) *
                                     (static_cast<std::ptrdiff_t>(y) * picture.width + part.x);
    result.pixels.insert(result.pixels.end(), row,
                         row + static_cast<std::ptrdiff_t>(picture.channels) * part.width);
  }
  return result;
}

}  // namespace nacre
