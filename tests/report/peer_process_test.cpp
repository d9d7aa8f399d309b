#include "report/peer_process.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace nacre {
namespace {

/// A peer in a line of shell: one pixel for each order, four spaces as its float.
constexpr const char* kPainter =
    "sh -c 'echo ready; while read caster step view; do"
    " if [ $caster = gpu ]; then echo refused no card, no picture;"
    " else echo picture $step 1 1 painter of view $view; printf \"    \"; fi; done'";

constexpr float kFourSpaces = 1.3563156e-19F;  // 0x20202020

TEST(PeerProcess, DrawsWhatItIsTold) {
  PeerProcess painter(kPainter);
  for (const std::size_t view : {3, 4}) {
    const PeerFrame frame = painter.draw({"fixed", 0.5}, view);
    EXPECT_EQ(frame.seconds, 0.5);
    EXPECT_EQ(frame.device, "painter of view " + std::to_string(view));
    ASSERT_EQ(frame.picture.pixels.size(), 1U);
    EXPECT_FLOAT_EQ(frame.picture.pixels.front(), kFourSpaces);
  }
}

TEST(PeerProcess, RefusalsCarryTheReasonAndEndNothing) {
  PeerProcess painter(kPainter);
  testing::expect_error(ErrorCode::Unsupported, "no card, no picture", [&] {
    painter.draw({"gpu", 1.0}, 0);
  });
  EXPECT_EQ(painter.draw({"fixed", 1.0}, 0).seconds, 1.0);
}

TEST(PeerProcess, OneThatEndsIsLostNotWaitedFor) {
  testing::expect_error(ErrorCode::Unsupported, "found no answer", [] { PeerProcess("true"); });
  testing::expect_error(ErrorCode::Unsupported, "found no answer",
                        [] { PeerProcess("/no/such/program 2> /dev/null"); });
  PeerProcess brief("sh -c 'echo ready; read order'");
  testing::expect_error(ErrorCode::Unsupported, "found no answer", [&] {
    brief.draw({"fixed", 1.0}, 0);
  });
  testing::expect_error(ErrorCode::Unsupported, "found no answer", [&] {
    brief.draw({"fixed", 1.0}, 0);
  });
}

}  // namespace
}  // namespace nacre
