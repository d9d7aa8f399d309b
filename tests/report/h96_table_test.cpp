#include "report/h96_table.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace nacre {
namespace {

/// A case of four frames a second by every method, of black pictures.
H96Case bare_case() {
  H96Case bare{"HIPIP", "phantom hipip", "64 x 64 x 64", 11, {}};
  for (const Method& method : h96_methods(11)) {
    Measured row;
    row.method = method;
    row.frame_seconds = {0.25, 0.25, 0.25, 1};
    row.first_view.volume = make_image(8, 8);
    bare.measured.rows.push_back(row);
  }
  return bare;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(H96Table, PaperFiguresStandBesideTheRowsOfTheirDataShellsAndMode) {
  const std::vector<H96Figure> paper = read_h96_figures(
      "data_set,levels,mode,frames_per_s\r\nHIPIP,11,maximum,3.125\r\nHIPIP,6,summation,9.75\r\n",
      "paper.csv");
  ASSERT_EQ(paper.size(), 2U);
  const H96Case bare = bare_case();
  std::size_t maxima = 0;
  for (const Measured& row : bare.measured.rows) {
    if (row.method.subject.mode == PictureMode::Max) ++maxima;
  }
  const std::string page = h96_page({bare}, paper, {});
  EXPECT_EQ(count_of(page, "<td>3.125</td>"), maxima);
  EXPECT_EQ(count_of(page, "9.75"), 0U) << "of another number of shells";
  EXPECT_EQ(count_of(h96_csv({bare}, paper), ",3.125\r\n"), maxima);
}

TEST(H96Table, WithoutThePaperNothingIsPutInItsPlace) {
  const H96Case bare = bare_case();
  EXPECT_EQ(count_of(h96_page({bare}, {}, {}), "<td>not at hand</td>"), bare.measured.rows.size());
}

TEST(H96Table, RefusesFiguresThatAreNone) {
  for (const char* line : {"HIPIP,11,maximum", "HIPIP,eleven,maximum,3", "HIPIP,11,mean,3",
                           "HIPIP,11,maximum,-3", "HIPIP,11,maximum,3,4", "HIPIP,11,maximum,3x"}) {
    testing::expect_error(ErrorCode::BadFile, "paper.csv: line 1: found 'HIPIP,",
                          [&] { read_h96_figures(line, "paper.csv"); });
  }
}

}  // namespace
}  // namespace nacre
