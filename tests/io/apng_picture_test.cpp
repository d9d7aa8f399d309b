#include "io/apng_picture.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "io/png_picture.h"
#include "tests/support/expect_error.h"
#include "tests/support/scratch_folder.h"

namespace nacre {
namespace {

using testing::expect_error;
using testing::read_bytes;
using testing::ScratchFolder;

/// A frame in which every sample differs from its neighbours and from other frames'.
DisplayImage frame(int channels, unsigned seed, int width = 5, int height = 3) {
  DisplayImage image{width, height, channels, {}};
  const int samples = width * height * channels;
  for (int i = 0; i < samples; ++i) {
    image.pixels.push_back(
        static_cast<std::uint16_t>(257u * ((seed + 37u * static_cast<unsigned>(i)) % 256u)));
  }
  return image;
}

struct Chunk {
  std::string type;
  std::string data;
};

std::uint32_t number(const std::string& bytes, std::size_t at, int size = 4) {
  std::uint32_t value = 0;
  for (int i = 0; i < size; ++i) {
    value = value << 8 | static_cast<std::uint8_t>(bytes.at(at + static_cast<std::size_t>(i)));
  }
  return value;
}

/// The CRC of the PNG specification's annex D, bit by bit.
std::uint32_t checksum(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char c : bytes) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

/// All chunks of a file, their checksums checked.
std::vector<Chunk> chunks_of(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  std::vector<Chunk> chunks;
  std::size_t at = 8;
  while (at < bytes.size()) {
    const std::size_t size = number(bytes, at);
    chunks.push_back({bytes.substr(at + 4, 4), bytes.substr(at + 8, size)});
    EXPECT_EQ(number(bytes, at + 8 + size), checksum(bytes.substr(at + 4, size + 4)))
        << chunks.back().type;
    at += 12 + size;
  }
  EXPECT_EQ(at, bytes.size());
  return chunks;
}

/// The samples of one frame: inflated, and each row's filter undone (PNG specification, 9.2).
std::string samples_of(const std::string& packed, std::size_t rows, std::size_t row_size,
                       std::size_t pixel_size) {
  std::string raw(rows * (row_size + 1) + 1, '\0');
  uLongf size = raw.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(raw.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  EXPECT_EQ(size, rows * (row_size + 1));
  std::string out(rows * row_size, '\0');
  const auto at = [&](std::size_t y, std::size_t x) -> int {  // 1-based: row and column 0 are 0
    if (y == 0 || x < pixel_size) return 0;
    return static_cast<std::uint8_t>(out[(y - 1) * row_size + x - pixel_size]);
  };
  for (std::size_t y = 1; y <= rows; ++y) {
    const int filter = raw[(y - 1) * (row_size + 1)];
    for (std::size_t i = 0; i < row_size; ++i) {
      const std::size_t x = i + pixel_size;
      const int left = at(y, i), up = at(y - 1, x), corner = at(y - 1, i);
      const int estimate = left + up - corner;
      const int dl = std::abs(estimate - left), du = std::abs(estimate - up),
                dc = std::abs(estimate - corner);
      const int paeth = dl <= du && dl <= dc ? left : du <= dc ? up : corner;
      const int predictions[] = {0, left, up, (left + up) / 2, paeth};
      out[(y - 1) * row_size + i] =
          static_cast<char>(raw[(y - 1) * (row_size + 1) + 1 + i] + predictions[filter]);
    }
  }
  return out;
}

/// A frame's samples as a PNG has them.
std::string expected_samples(const DisplayImage& image, int bits) {
  std::string samples;
  for (const std::uint16_t value : image.pixels) {
    if (bits == 16) samples += static_cast<char>(value >> 8);
    samples += static_cast<char>(value & 0xff);  // all are multiples of 257
  }
  return samples;
}

void write(const std::filesystem::path& path, int channels, int bits, unsigned frames) {
  ApngWriter writer(path, frames, 120, bits);
  for (unsigned i = 0; i < frames; ++i) writer.add(frame(channels, i));
  writer.commit();
}

TEST(ApngPicture, HoldsEveryFrameAsTheSpecificationSays) {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.apng";
  for (const int channels : {1, 3}) {
    for (const int bits : {8, 16}) {
      write(path, channels, bits, 3);
      const std::vector<Chunk> chunks = chunks_of(read_bytes(path));
      std::string order;
      for (const Chunk& chunk : chunks) order += chunk.type + " ";
      EXPECT_EQ(order, "IHDR acTL fcTL IDAT fcTL fdAT fcTL fdAT IEND ");
      EXPECT_EQ(number(chunks[1].data, 0), 3u);  // frames
      EXPECT_EQ(number(chunks[1].data, 4), 0u);  // plays: for ever
      const auto pixel = static_cast<std::size_t>(channels * bits / 8);
      for (unsigned i = 0; i < 3; ++i) {
        const std::string& control = chunks[2 + 2 * i].data;
        ASSERT_EQ(control.size(), 26u);
        EXPECT_EQ(number(control, 0), i == 0 ? 0 : 2 * i - 1);  // sequence: 0; 1, 2; 3, 4
        EXPECT_EQ(number(control, 4), 5u);
        EXPECT_EQ(number(control, 8), 3u);
        EXPECT_EQ(number(control, 20, 2), 120u);
        EXPECT_EQ(number(control, 22, 2), 1000u);
        std::string data = chunks[3 + 2 * i].data;
        if (i > 0) {
          EXPECT_EQ(number(data, 0), 2 * i);
          data.erase(0, 4);
        }
        EXPECT_EQ(samples_of(data, 3, 5 * pixel, pixel), expected_samples(frame(channels, i), bits))
            << channels << " channels, " << bits << " bits, frame " << i;
      }
    }
  }
}

TEST(ApngPicture, IsItsFirstFrameToWhomKnowsNoAnimation) {
  const ScratchFolder folder;
  write(folder.path() / "a.apng", 3, 8, 4);
  EXPECT_EQ(read_png(folder.path() / "a.apng").pixels, frame(3, 0).pixels);
}

TEST(ApngPicture, LeavesNothingBehindUnlessCommitted) {
  const ScratchFolder folder;
  {
    ApngWriter writer(folder.path() / "a.apng", 2, 100);
    writer.add(frame(1, 0));
    expect_error(ErrorCode::BadArgument, "1 frames, expected 2", [&] { writer.commit(); });
  }
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(ApngPicture, RefusesFramesThatDiffer) {
  const ScratchFolder folder;
  ApngWriter writer(folder.path() / "a.apng", 2, 100);
  writer.add(frame(1, 0));
  expect_error(ErrorCode::BadArgument, "3 channels", [&] { writer.add(frame(3, 0)); });
  expect_error(ErrorCode::BadArgument, "6 x 3", [&] { writer.add(frame(1, 0, 6, 3)); });
  writer.add(frame(1, 1));
  expect_error(ErrorCode::BadArgument, "frame 3", [&] { writer.add(frame(1, 2)); });
}

TEST(ApngPicture, RefusesNumbersOutOfRange) {
  const ScratchFolder folder;
  const auto path = folder.path() / "a.apng";
  expect_error(ErrorCode::BadArgument, "0 frames", [&] { ApngWriter(path, 0, 100); });
  expect_error(ErrorCode::BadArgument, "65536 ms", [&] { ApngWriter(path, 1, 65536); });
  EXPECT_EQ(folder.file_count(), 0u);
}

}  // namespace
}  // namespace nacre
