// The views of a turntable: one window for all, all files or none.
#include "app/turntable_output.h"

#include <gtest/gtest.h>

#include "io/picture_file.h"
#include "io/png_picture.h"
#include "tests/support/expect_error.h"
#include "tests/support/scratch_folder.h"

namespace nacre {
namespace {

using testing::expect_error;
using testing::read_bytes;
using testing::ScratchFolder;

constexpr int kViews = 3;

/// View v is a row of the pixels 0 and v + 1.
Picture ramp(int view) {
  Picture picture{make_image(2, 1), std::nullopt};
  picture.volume.pixels[1] = static_cast<float>(view + 1);
  return picture;
}

/// The same with a tool in its first pixel, seen in the second view alone.
Picture with_tool(int view) {
  Picture picture = ramp(view);
  if (view != 1) return picture;
  picture.tools = make_tool_layer(2, 1);
  picture.tools->covered[0] = 1;
  picture.tools->colors[0] = {1.0f, 0.0f, 0.0f};
  return picture;
}

class Turntable : public ::testing::Test {
 protected:
  PictureFlags flags(const std::string& output, const std::string& mode) const {
    PictureFlags flags;
    flags.output = (folder_.path() / output).string();
    flags.mode = mode;
    return flags;
  }

  DisplayImage view(int number) const {
    return read_png(folder_.path() / ("t" + std::to_string(number) + ".png"));
  }

  ScratchFolder folder_;
};

TEST_F(Turntable, ShowsASumUpToTheLargestPixelOfAllViews) {
  for (const std::size_t most_kept : {std::size_t{1} << 20, std::size_t{20}, std::size_t{0}}) {
    int drawn = 0;
    const TurntableResult result = write_views(
        flags("t%d.png", "sum"), {.views = kViews, .most_kept_bytes = most_kept}, [&](int number) {
          ++drawn;
          return ramp(number);
        });
    EXPECT_EQ(drawn, most_kept > 100 ? kViews : 2 * kViews);
    EXPECT_EQ(result.window->hi, 3.0);
    EXPECT_EQ(result.last.volume.pixels, ramp(kViews - 1).volume.pixels);
    for (int i = 0; i < kViews; ++i) {
      EXPECT_EQ(view(i).pixels[1], 257 * ((i + 1) * 255 / 3)) << i;
    }
  }
}

TEST_F(Turntable, DrawsOnceWhereTheWindowIsKnown) {
  PictureFlags chosen = flags("t%d.png", "sum");
  chosen.display = "0,6";
  for (const PictureFlags& wanted : {chosen, flags("t%d.png", "max")}) {
    int drawn = 0;
    write_views(wanted, {.views = kViews, .most_kept_bytes = 0}, [&](int number) {
      ++drawn;
      return ramp(number);
    });
    EXPECT_EQ(drawn, kViews);
  }
  EXPECT_EQ(view(0).pixels[1], 65535);
}

TEST_F(Turntable, StoresWhatWasMeasuredInTiffs) {
  write_views(flags("t%d.tif", "sum"), {.views = kViews, .tools = true}, with_tool);
  for (int i = 0; i < kViews; ++i) {
    const PictureFile file = read_picture(folder_.path() / ("t" + std::to_string(i) + ".tif"));
    EXPECT_EQ(file.image.pixels, ramp(i).volume.pixels);  // the volume's part alone
    EXPECT_EQ(file.mode, PictureMode::Sum);
  }
}

TEST_F(Turntable, IsOneAnimatedPngIfAsked) {
  write_views(flags("t.apng", "max"), {.views = kViews}, ramp);
  EXPECT_EQ(folder_.file_count(), 1u);
  const std::string bytes = read_bytes(folder_.path() / "t.apng");
  EXPECT_NE(bytes.find("acTL"), std::string::npos);
  EXPECT_EQ(read_png(folder_.path() / "t.apng").channels, 1);
}

TEST_F(Turntable, HasColoursInAllViewsIfATool) {
  write_views(flags("t.apng", "max"), {.views = kViews, .tools = true}, with_tool);
  EXPECT_EQ(read_png(folder_.path() / "t.apng").channels, 3);
  write_views(flags("t%d.png", "max"), {.views = kViews, .tools = true}, with_tool);
  for (int i = 0; i < kViews; ++i) EXPECT_EQ(view(i).channels, 3);
  EXPECT_EQ(view(1).pixels[0], 65535);
  EXPECT_EQ(view(1).pixels[1], 0);
  write_views(flags("t%d.png", "max"), {.views = 1, .tools = true}, with_tool);
  EXPECT_EQ(view(0).channels, 1);  // a single picture without its tool in sight
}

TEST_F(Turntable, LeavesNothingAndChangesNothingOnError) {
  folder_.write("t0.png", "old");
  for (const char* output : {"t%d.png", "t%d.tif", "t.apng"}) {
    for (const char* mode : {"max", "sum"}) {
      expect_error(ErrorCode::Unsupported, "lost", [&] {
        write_views(flags(output, mode), {.views = kViews}, [](int number) {
          if (number == 2) throw Error(ErrorCode::Unsupported, "the context was lost");
          return ramp(number);
        });
      });
      EXPECT_EQ(folder_.file_count(), 1u) << output;
      EXPECT_EQ(read_bytes(folder_.path() / "t0.png"), "old");
    }
  }
}

TEST_F(Turntable, FindsABadNameBeforeItDraws) {
  for (const char* output : {"none/t%d.png", "none/t%d.tif", "none/t.apng"}) {
    for (const char* mode : {"max", "sum"}) {
      expect_error(ErrorCode::BadArgument, "cannot be created", [&] {
        write_views(flags(output, mode), {.views = kViews}, [](int number) {
          ADD_FAILURE() << "drawn";
          return ramp(number);
        });
      });
    }
  }
}

TEST_F(Turntable, WithoutAnOutputIsDrawnAndNotWritten) {
  PictureFlags none;
  int drawn = 0;
  const TurntableResult result = write_views(none, {.views = kViews}, [&](int number) {
    ++drawn;
    return ramp(number);
  });
  EXPECT_EQ(drawn, kViews);
  EXPECT_FALSE(result.window.has_value());
  EXPECT_EQ(result.last.volume.pixels, ramp(kViews - 1).volume.pixels);
}

}  // namespace
}  // namespace nacre
