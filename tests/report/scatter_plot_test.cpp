#include "report/scatter_plot.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

#include "report/page_words.h"

namespace nacre {
namespace {

constexpr double kExact = std::numeric_limits<double>::infinity();

PlotSeries series(std::vector<PlotPoint> points) { return {"shells", 1, std::move(points)}; }

TEST(ScatterPlot, FrontHoldsWhatNoOtherBeats) {
  const auto front = on_front({series({{1.0, 30.0, "", ""},        // cheapest
                                       {2.0, 29.0, "", ""},        // dearer and worse
                                       {3.0, 40.0, "", ""},        // better for more
                                       {3.0, 40.0, "", ""}}),      // its equal
                               series({{9.0, kExact, "", ""}})});  // no error
  ASSERT_EQ(front.size(), 2U);
  EXPECT_EQ(front[0], (std::vector<bool>{true, false, true, true}));
  EXPECT_EQ(front[1], (std::vector<bool>{true}));
}

TEST(ScatterPlot, TheTruthBeatsAllThatIsDearer) {
  const auto front = on_front(
      {series({{2.0, kExact, "", ""}, {1.0, 20.0, "", ""}}), series({{3.0, 60.0, "", ""}})});
  EXPECT_EQ(front[0], (std::vector<bool>{true, true}));
  EXPECT_EQ(front[1], (std::vector<bool>{false}));
}

TEST(ScatterPlot, NeedsNothingFromElsewhereAndEscapesWords) {
  const std::string svg = to_svg(
      {"a < b", "ms", 1e-3, {series({{0.5, 30.0, "24", "x & y"}, {0.02, kExact, "exact", ""}})}});
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
  EXPECT_NE(svg.find("x &amp; y"), std::string::npos);
  for (const char* foreign : {"http", "href", "url(", "nan", "inf"}) {
    EXPECT_EQ(svg.find(foreign), std::string::npos) << foreign;
  }
}

TEST(ScatterPlot, CheaperIsLeftAndBetterIsUp) {
  const std::string svg =
      to_svg({"", "", 1.0, {series({{1.0, 30.0, "", ""}, {100.0, 50.0, "", ""}})}});
  const auto number_after = [&](const std::string& key, std::size_t from) {
    return std::stod(svg.substr(svg.find(key, from) + key.size()));
  };
  const std::size_t second = svg.find("<circle", svg.find("<circle") + 1);
  EXPECT_LT(number_after("cx=\"", 0), number_after("cx=\"", second));
  EXPECT_GT(number_after("cy=\"", 0), number_after("cy=\"", second));
}

TEST(ScatterPlot, EveryBackendHasAMarkOfItsOwn) {
  std::set<std::string> marks;
  for (const char* backend : {"exact", "sampled", "cpu", "osmesa", "egl", "vtk-fixed", "vtk-gpu"}) {
    EXPECT_TRUE(marks.insert(legend_mark(style_of(backend))).second) << backend;
  }
}

TEST(ScatterPlot, NothingToShowIsNoPlot) { EXPECT_EQ(to_svg({"", "", 1.0, {}}), ""); }

}  // namespace
}  // namespace nacre
