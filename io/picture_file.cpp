#include "io/picture_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>

#include "core/error.h"
#include "io/png_picture.h"
#include "io/tiff_picture.h"

namespace nacre {
namespace {

struct ModeText {
  PictureMode mode;
  std::string_view description;
};

constexpr std::array<ModeText, 4> kModeTexts{{
    {PictureMode::Max, "nacre max: emission, 0 to 1"},
    {PictureMode::Sum, "nacre sum: emission * mm"},
    {PictureMode::Count, "nacre count: sum of brightness"},
    {PictureMode::Iso, "nacre iso: brightness, 0 to 1"},
}};

std::string description_of(PictureMode mode) {
  const auto* const text =
      std::find_if(kModeTexts.begin(), kModeTexts.end(),
                   [mode](const ModeText& entry) { return entry.mode == mode; });
  return std::string(text->description);
}

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

PictureFile from_png(const std::filesystem::path& path) {
  const DisplayImage png = read_png(path);
  if (png.channels != 1) {
    throw Error(ErrorCode::BadFile, fmt::format("{}: found {} channels, expected a gray picture",
                                                path.string(), png.channels));
  }
  PictureFile file{make_image(png.width, png.height), std::nullopt};
  std::transform(png.pixels.begin(), png.pixels.end(), file.image.pixels.begin(),
                 [](std::uint16_t value) { return static_cast<float>(value) / 65535.0f; });
  return file;
}

PictureFile from_tiff(const std::filesystem::path& path) {
  TiffPicture tiff = read_tiff(path);
  PictureFile file{std::move(tiff.image), std::nullopt};
  for (const auto& [mode, description] : kModeTexts) {
    if (tiff.description == description) file.mode = mode;
  }
  if (std::any_of(file.image.pixels.begin(), file.image.pixels.end(),
                  [](float pixel) { return !std::isfinite(pixel); })) {
    throw Error(
        ErrorCode::BadFile,
        fmt::format("{}: found NaN or infinite pixels, expected finite ones", path.string()));
  }
  return file;
}

}  // namespace

PictureFormat picture_format(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".png") return PictureFormat::Png;
  if (extension == ".apng") return PictureFormat::Apng;
  if (extension == ".tif" || extension == ".tiff") return PictureFormat::Tiff;
  throw Error(ErrorCode::BadArgument,
              fmt::format("{}: found the ending '{}', expected .png, .tif, .tiff or .apng",
                          path.string(), extension));
}

PictureFile read_picture(const std::filesystem::path& path) {
  return picture_format(path) == PictureFormat::Tiff ? from_tiff(path) : from_png(path);
}

std::vector<std::byte> encode_measured_picture(const Image& image, PictureMode mode) {
  return encode_tiff(image, description_of(mode));
}

void write_measured_picture(const Image& image, PictureMode mode,
                            const std::filesystem::path& path) {
  write_tiff(image, path, description_of(mode));
}

}  // namespace nacre
