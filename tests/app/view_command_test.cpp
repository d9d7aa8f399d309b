// The page's text, and `nacre view` where it writes a page or refuses. What is served is looked at
// in page_server_test.cpp, and in a browser in tests/viewer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "app/view_page.h"
#include "core/error.h"
#include "tests/support/command_test.h"
#include "tests/support/scratch_folder.h"
#include "viewer/page.h"

namespace nacre {
namespace {

using testing::CommandResult;

constexpr const char* kNoPage = "built without the viewer's page";

std::vector<std::byte> bytes_of(const std::string& text) {
  std::vector<std::byte> bytes(text.size());
  std::transform(text.begin(), text.end(), bytes.begin(),
                 [](char c) { return static_cast<std::byte>(c); });
  return bytes;
}

/// What stands in the place of the set.
std::string set_text(const std::string& page) {
  const std::string whole = viewer_page();
  const std::size_t begin = whole.find(viewer_set_mark());
  const std::size_t rest = whole.size() - begin - std::string(viewer_set_mark()).size();
  EXPECT_EQ(page.substr(0, begin), whole.substr(0, begin));
  EXPECT_EQ(page.substr(page.size() - rest), whole.substr(whole.size() - rest));
  return page.substr(begin, page.size() - rest - begin);
}

TEST(ViewPage, HasRoomForOneSet) {
  const std::string page = viewer_page();
  if (page.empty()) GTEST_SKIP() << kNoPage;
  const std::string mark = viewer_set_mark();
  EXPECT_EQ(page.find(mark), page.rfind(mark));
  EXPECT_NE(page.find(mark), std::string::npos);
}

// RFC 4648, section 10.
TEST(ViewPage, HoldsTheSetInBase64) {
  if (viewer_page().empty()) GTEST_SKIP() << kNoPage;
  EXPECT_EQ(set_text(page_with_set({})), "");
  EXPECT_EQ(set_text(page_with_set(bytes_of("f"))), "Zg==");
  EXPECT_EQ(set_text(page_with_set(bytes_of("fo"))), "Zm8=");
  EXPECT_EQ(set_text(page_with_set(bytes_of("foo"))), "Zm9v");
  EXPECT_EQ(set_text(page_with_set(bytes_of("foobar"))), "Zm9vYmFy");
  EXPECT_EQ(set_text(page_with_set(bytes_of("\xfb\xff\xbe"))), "+/++");
}

TEST(ViewPage, NoBytesOfASetEndItsElement) {
  if (viewer_page().empty()) GTEST_SKIP() << kNoPage;
  const std::string text = set_text(page_with_set(
      bytes_of("</script><script>alert(1)</script><!--" + std::string(viewer_set_mark()))));
  EXPECT_EQ(
      text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/="),
      std::string::npos);
}

TEST(ViewPage, SaysWhereItsSetIsFetched) {
  if (viewer_page().empty()) GTEST_SKIP() << kNoPage;
  EXPECT_EQ(set_text(page_that_fetches(false)), "fetch:set.glb");
  EXPECT_EQ(set_text(page_that_fetches(true)), "live:set.glb");
}

TEST(ViewPage, IsKnownByItsName) {
  EXPECT_TRUE(is_page_name("a/b.html"));
  EXPECT_FALSE(is_page_name("a/b.htm"));
  EXPECT_FALSE(is_page_name("b.html/set.glb"));
}

class ViewCommand : public testing::CommandTest {
 protected:
  void SetUp() override {
    if (viewer_page().empty()) GTEST_SKIP() << kNoPage;
    if (!NACRE_HAS_SHELLS) GTEST_SKIP() << "built without the shell tools";
    ASSERT_EQ(nacre("phantom spheres --size 20,18,16 -o ball.nii").status, 0);
    ASSERT_EQ(nacre("build ball.nii --window 0,28 --levels 2 --placement uniform --certificate "
                    "none -o ball.glb")
                  .status,
              0);
  }

  std::string contents(const std::string& name) const {
    return testing::read_bytes(folder_.path() / name);
  }
};

TEST_F(ViewCommand, WritesThePageOfASet) {
  ASSERT_EQ(nacre("view ball.glb -o ball.html").status, 0);
  EXPECT_EQ(contents("ball.html"), page_with_set(bytes_of(contents("ball.glb"))));
}

TEST_F(ViewCommand, RefusesWhatItCannotShowInALine) {
  folder_.write("cut.glb", contents("ball.glb").substr(0, 300));
  folder_.write("noise.glb", "no set at all");
  expect_refusal("view", 2, "INPUT");
  expect_refusal("view missing.glb", 3, "missing.glb");
  expect_refusal("view cut.glb -o page.html", 3, "cut.glb");
  expect_refusal("view noise.glb", 3, "noise.glb");
  expect_refusal("view ball.glb -o page.txt", 2, "expected .html");
  expect_refusal("view ball.glb -o missing/page.html", 2, "missing/page.html");
  expect_refusal("view ball.nii --tolerance-weight picture -o page.html", 2, "no --tolerance");
  expect_refusal("view ball.glb --port 70000", 2, "--port");
  expect_refusal("view ball.glb --port x", 2, "--port");
}

}  // namespace
}  // namespace nacre
