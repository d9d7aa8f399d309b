#include "io/picture_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <random>

#include "io/png_picture.h"
#include "io/tiff_picture.h"
#include "tests/support/expect_error.h"
#include "tests/support/scratch_folder.h"

namespace nacre {
namespace {

using testing::expect_error;
using testing::read_bytes;
using testing::ScratchFolder;

Image ramp(int width, int height) {
  Image image = make_image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = 0.1f * static_cast<float>(i) - 1.0f;
  }
  return image;
}

TEST(TiffPicture, KeepsEveryBit) {
  const ScratchFolder folder;
  Image image = ramp(7, 5);
  image.pixels[3] = std::numeric_limits<float>::denorm_min();
  image.pixels[4] = std::numeric_limits<float>::max();
  write_tiff(image, folder.path() / "a.tif", "what it is");
  const TiffPicture read = read_tiff(folder.path() / "a.tif");
  EXPECT_EQ(read.image.width, 7);
  EXPECT_EQ(read.image.height, 5);
  EXPECT_EQ(read.image.pixels, image.pixels);
  EXPECT_EQ(read.description, "what it is");
  EXPECT_EQ(folder.file_count(), 1u);
}

// Read with nothing but the TIFF 6.0 specification: little endian, one uncompressed strip.
TEST(TiffPicture, IsPlainTiff) {
  const ScratchFolder folder;
  const Image image = ramp(3, 2);
  write_tiff(image, folder.path() / "a.tif", "x");
  const std::string bytes = read_bytes(folder.path() / "a.tif");
  const auto u16 = [&](std::size_t at) {
    return static_cast<unsigned>(static_cast<unsigned char>(bytes[at])) |
           static_cast<unsigned>(static_cast<unsigned char>(bytes[at + 1])) << 8;
  };
  const auto u32 = [&](std::size_t at) { return u16(at) | u16(at + 2) << 16; };
  ASSERT_EQ(bytes.substr(0, 2), "II");
  ASSERT_EQ(u16(2), 42u);
  const std::size_t directory = u32(4);
  std::map<unsigned, unsigned> numbers;
  for (unsigned i = 0; i < u16(directory); ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    const bool is_short = u16(entry + 2) == 3;
    numbers[u16(entry)] = is_short ? u16(entry + 8) : u32(entry + 8);
  }
  EXPECT_EQ(numbers[256], 3u);             // ImageWidth
  EXPECT_EQ(numbers[257], 2u);             // ImageLength
  EXPECT_EQ(numbers[258], 32u);            // BitsPerSample
  EXPECT_EQ(numbers[259], 1u);             // Compression: none
  EXPECT_EQ(numbers[339], 3u);             // SampleFormat: IEEE float
  const std::size_t strip = numbers[273];  // StripOffsets
  ASSERT_NE(strip, 0u);
  for (std::size_t i = 0; i < 6; ++i) {
    float pixel = 0.0f;
    std::memcpy(&pixel, bytes.data() + strip + 4 * i, 4);
    EXPECT_EQ(pixel, image.pixels[i]);
  }
}

TEST(PngPicture, KeepsGrayAndColour) {
  const ScratchFolder folder;
  for (const int channels : {1, 3}) {
    DisplayImage picture{5, 4, channels, {}};
    for (int i = 0; i < 5 * 4 * channels; ++i) {
      picture.pixels.push_back(static_cast<std::uint16_t>(257 * (7 * i % 256)));
    }
    for (const int bits : {8, 16}) {
      write_png(picture, folder.path() / "a.png", bits);
      const DisplayImage read = read_png(folder.path() / "a.png");
      EXPECT_EQ(read.channels, channels);
      EXPECT_EQ(read.pixels, picture.pixels) << bits << " bits";
    }
  }
  EXPECT_EQ(folder.file_count(), 1u);
  expect_error(ErrorCode::BadArgument, "12 bits",
               [&] { write_png({}, folder.path() / "b.png", 12); });
}

TEST(PictureFile, CarriesItsMode) {
  const ScratchFolder folder;
  for (const PictureMode mode :
       {PictureMode::Max, PictureMode::Sum, PictureMode::Count, PictureMode::Iso}) {
    write_measured_picture(ramp(2, 2), mode, folder.path() / "a.tiff");
    EXPECT_EQ(read_picture(folder.path() / "a.tiff").mode, mode);
  }
  write_tiff(ramp(2, 2), folder.path() / "b.tif", "from elsewhere");
  EXPECT_FALSE(read_picture(folder.path() / "b.tif").mode.has_value());
}

TEST(PictureFile, RefusesWhatItCannotBe) {
  const ScratchFolder folder;
  expect_error(ErrorCode::BadArgument, ".jpg", [&] { picture_format("a.jpg"); });
  expect_error(ErrorCode::BadFile, "cannot be opened",
               [&] { read_picture(folder.path() / "none.tif"); });
  expect_error(ErrorCode::BadFile, "cannot be opened",
               [&] { read_picture(folder.path() / "none.png"); });
  expect_error(ErrorCode::BadFile, "no TIFF",
               [&] { read_picture(folder.write("c.tif", "not a tiff")); });
  expect_error(ErrorCode::BadFile, "damaged",
               [&] { read_picture(folder.write("c.png", "not a png")); });
  write_png({1, 1, 3, {1, 2, 3}}, folder.path() / "rgb.png");
  expect_error(ErrorCode::BadFile, "3 channels", [&] { read_picture(folder.path() / "rgb.png"); });
  Image holed = ramp(2, 2);
  holed.pixels[1] = std::nanf("");
  write_tiff(holed, folder.path() / "nan.tif", "");
  expect_error(ErrorCode::BadFile, "NaN", [&] { read_picture(folder.path() / "nan.tif"); });
  expect_error(ErrorCode::BadArgument, "cannot be created",
               [&] { write_tiff(ramp(1, 1), folder.path() / "no" / "a.tif", ""); });
}

TEST(PictureFile, DamagedFilesGiveAnErrorOrAPicture) {
  const ScratchFolder folder;
  write_tiff(ramp(9, 9), folder.path() / "a.tif", "text");
  DisplayImage gray{9, 9, 1, std::vector<std::uint16_t>(81, 1000)};
  write_png(gray, folder.path() / "a.png", 16);
  std::mt19937 random(1);
  for (const char* name : {"a.tif", "a.png"}) {
    const std::string whole = read_bytes(folder.path() / name);
    for (int trial = 0; trial < 400; ++trial) {
      std::string bytes = whole;
      if (trial % 2 == 0) {
        bytes.resize(random() % bytes.size());
      } else {
        bytes[random() % bytes.size()] ^= static_cast<char>(1 << random() % 8);
      }
      const auto path = folder.write(std::string("damaged_") + name, bytes);
      try {
        const PictureFile file = read_picture(path);
        EXPECT_EQ(file.image.pixels.size(), static_cast<std::size_t>(file.image.width) *
                                                static_cast<std::size_t>(file.image.height));
      } catch (const Error&) {
      }
    }
  }
}

}  // namespace
}  // namespace nacre
