#include "report/markup.h"

#include <algorithm>
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

}  // namespace nacre
