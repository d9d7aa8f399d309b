// Pictures that a page asks its server for: those of `nacre render`, and what is refused.
#include "app/served_pictures.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "io/png_picture.h"
#include "tests/app/shell_command.h"
#include "tests/support/expect_error.h"
#include "tests/support/scratch_folder.h"

namespace nacre {
namespace {

using testing::expect_error;
using testing::ShellCommand;

std::vector<std::byte> unpacked(const std::vector<std::byte>& packed) {
  std::vector<std::byte> bytes;
  const auto two = [&](std::size_t at) {
    return std::to_integer<std::size_t>(packed.at(at)) |
           std::to_integer<std::size_t>(packed.at(at + 1)) << 8U;
  };
  for (std::size_t at = 0; at < packed.size();) {
    bytes.resize(bytes.size() + two(at));
    const std::size_t others = two(at + 2);
    at += 4;
    for (std::size_t end = at + others; at < end; ++at) bytes.push_back(packed.at(at));
  }
  return bytes;
}

TEST(PackRuns, KeepEveryByte) {
  std::mt19937 random(7);
  for (const std::size_t size : {0, 1, 7, 8, 9, 1000, 70'000, 200'000}) {
    for (const unsigned dark : {0U, 50U, 95U, 100U}) {
      std::vector<std::byte> bytes(size);
      std::size_t run = 0;
      bool zero = false;
      for (std::byte& b : bytes) {
        if (run-- == 0) {
          run = random() % 40;
          zero = random() % 100 < dark;
        }
        b = static_cast<std::byte>(zero ? 0 : random() % 256);
      }
      const std::vector<std::byte> packed = pack_runs(bytes);
      EXPECT_EQ(unpacked(packed), bytes) << size << " bytes, " << dark << " % dark";
      EXPECT_LE(packed.size(), size + 4 * (size / 8 + 1));
    }
  }
  EXPECT_EQ(pack_runs(std::vector<std::byte>(60'000)).size(), 4u);
}

class ServedPicturesOfABall : public ShellCommand {
 protected:
  void SetUp() override {
    ShellCommand::SetUp();
    if (IsSkipped()) return;
    for (const char c : testing::read_bytes(folder_.path() / "ball.glb")) {
      set_.push_back(static_cast<std::byte>(c));
    }
  }

  /// Of a gray PNG with 8 bits.
  std::vector<std::byte> gray_pixels(const std::string& name) const {
    const DisplayImage image = read_png(folder_.path() / name);
    EXPECT_EQ(image.channels, 1);
    std::vector<std::byte> bytes;
    for (const std::uint16_t pixel : image.pixels) {
      bytes.push_back(static_cast<std::byte>(pixel >> 8U));
    }
    return bytes;
  }

  std::vector<std::byte> set_;
};

TEST_F(ServedPicturesOfABall, AreThoseOfTheCommand) {
  ServedPictures pictures(set_);
  const std::vector<PictureRequest> requests{
      {{"size", "96x64"}},
      {{"size", "64x64"}, {"azimuth", "-30"}, {"elevation", "20"}, {"layers", "smooth"}},
      {{"size", "64x64"}, {"perspective", "40"}, {"display", "0.2,0.8"}, {"layers", "flat"}},
      {{"size", "64x64"}, {"view", "superior"}, {"slab", "-2,3"}, {"hide", "1,3"}},
      {{"size", "64x64"}, {"cue", "0.5,0.5,0"}, {"zoom", "2"}},
      {{"size", "64x64"}, {"mode", "sum"}}};
  for (const PictureRequest& request : requests) {
    std::string flags;
    for (const auto& [name, value] : request) flags += " --" + name + "=" + value;
    ASSERT_EQ(nacre("render ball.glb --backend cpu -o a.png" + flags).status, 0);
    EXPECT_EQ(unpacked(pictures.draw(request)), gray_pixels("a.png")) << flags;
  }
}

TEST_F(ServedPicturesOfABall, AreTheSameFromSeveralThreads) {
  ServedPictures pictures(set_);
  std::vector<std::vector<std::byte>> drawn(4);
  {
    std::vector<std::jthread> threads;
    for (std::vector<std::byte>& picture : drawn) {
      threads.emplace_back([&] { picture = pictures.draw({{"size", "64x64"}}); });
    }
  }
  for (const std::vector<std::byte>& picture : drawn) EXPECT_EQ(picture, drawn.front());
}

TEST_F(ServedPicturesOfABall, AreRefusedWhereFlagsAreWrong) {
  ServedPictures pictures(set_);
  const auto refused = [&](const PictureRequest& request, ErrorCode code, const std::string& part) {
    expect_error(code, part, [&] { (void)pictures.draw(request); });
  };
  refused({{"tool", "/etc/passwd"}}, ErrorCode::BadArgument, "tool: found a flag that pictures");
  refused({{"output", "a.png"}}, ErrorCode::BadArgument, "output: found a flag that pictures");
  refused({{"size", "8193x1"}}, ErrorCode::BadArgument,
          "--size: found 8193x1, expected up to 8192");
  refused({{"azimuth", "much"}}, ErrorCode::BadArgument, "azimuth");
  refused({{"cue", "1,0"}}, ErrorCode::BadArgument, "--cue: found '1,0'");
  refused({{"hide", "8"}}, ErrorCode::BadArgument, "--hide: found shell 8, expected 1 to 7");
  for (const char* window : {"1,0", "0.5,0.5", "nan,1", "0,inf"}) {
    refused({{"display", window}}, ErrorCode::BadArgument, "--display: found ");
  }
  refused({{"mode", "iso"}}, ErrorCode::Unsupported, "lit shells");
  EXPECT_FALSE(pictures.draw({{"size", "8x8"}}).empty());  // and still draws
}

}  // namespace
}  // namespace nacre
