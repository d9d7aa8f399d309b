// `nacre report` as a user has it: its rows can be repeated one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/command_test.h"

namespace nacre {
namespace {

using nlohmann::json;
using testing::CommandResult;

class ReportCommand : public testing::CommandTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(nacre("phantom spheres --size 16,15,14 -o ball.nii").status, 0);
  }

  json report(const std::string& flags) const {
    const CommandResult result = nacre(
        "report ball.nii --window 0,28 --size 40x30 --turntable 2 --quick -o out -q --json - " +
        flags);
    EXPECT_EQ(result.status, 0) << result.errors;
    return json::parse(result.output);
  }

  /// Runs a row's commands; the errors that the last of them, `compare`, finds.
  json repeated(const json& row) const {
    json found;
    for (const std::string& line : row["commands"].get<std::vector<std::string>>()) {
      EXPECT_EQ(line.rfind("nacre", 0), 0U) << line;
      const std::string program = line.substr(0, line.find(' '));
      const CommandResult result =
          testing::run_command(std::filesystem::path(NACRE_BINARY).replace_filename(program),
                               line.substr(program.size()) + " -q --json -", folder_.path());
      EXPECT_EQ(result.status, 0) << line << "\n" << result.errors;
      found = json::parse(result.output);
    }
    return found;
  }

  void expect_repeatable(const json& rows) const {
    for (const json& row : rows) {
      if (row.contains("left_out") || row["backend"] == "exact") continue;
      const json found = repeated(row);
      EXPECT_EQ(found["all"], row["error"]["all"]) << row["id"];
      EXPECT_EQ(found["lit"], row["error"]["lit"]) << row["id"];
      EXPECT_EQ(found["peak"], row["error"]["peak"]) << row["id"];
    }
  }
};

/// Rows of these ids.
json picked(const json& figures, const std::vector<std::string>& ids) {
  json rows = json::array();
  for (const json& row : figures["rows"]) {
    if (std::ranges::find(ids, row["id"].get<std::string>()) != ids.end()) rows.push_back(row);
  }
  EXPECT_EQ(rows.size(), ids.size());
  return rows;
}

TEST_F(ReportCommand, CommandsOfARowGiveItsError) {
  const json figures = report("--only simplified,quantised");
  expect_repeatable(picked(figures, {"simplified-0.02-cpu", "quantised-10-cpu"}));
}

TEST_F(ReportCommand, CommandsOfSamplesAndPeersToo) {
  const json figures = report("--only max --azimuth 20");  // along axes samples have no error
  std::vector<std::string> ids{"max-sampled-2"};
#if NACRE_HAS_VTK
  ids.emplace_back("max-vtk-fixed-1");
#endif
  expect_repeatable(picked(figures, ids));
}

#ifdef NDEBUG  // checked builds take their time to open a context for each command
TEST_F(ReportCommand, CommandsOfRowsWithToolsCuesAndTargetsToo) {
  const json figures = report("--only occlusion,depth,target");
  expect_repeatable(picked(figures, {"occlusion-texture-osmesa", "depth-16-osmesa",
                                     "target-sum-16f-osmesa", "target-iso-8-osmesa"}));
}
#endif

// The figures were stored by the command below with `--json`; only `rows[].id` and `rows[].error`
// of them are kept. They change when a method gets better, too: then store them again.
TEST_F(ReportCommand, NoErrorHasGrownByMoreThanATenth) {
  ASSERT_EQ(nacre("phantom angiogram --size 48,48,24 -o head.nii").status, 0);
  const CommandResult result = nacre(
      "report head.nii --window 400,1400 --quick --size 96x96 --turntable 1 -q -o out --against '" +
      std::string(NACRE_SOURCE_DIR "/tests/app/report_errors.json") + "'");
  EXPECT_EQ(result.status, 0) << result.errors;
}

TEST_F(ReportCommand, AnErrorThatGrewFailsWithALineThatSaysWhich) {
  json earlier = report("--only quantised");
  for (json& row : earlier["rows"]) {
    if (row["id"] == "quantised-10-cpu") row["error"]["lit"]["rmse"] = 1e-3;
  }
  folder_.write("earlier.json", earlier.dump());
  const CommandResult result = nacre(
      "report ball.nii --window 0,28 --size 40x30 --turntable 2 --quick -o out -q "
      "--only quantised --against earlier.json");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.errors.find("quantised-10-cpu: RMSE over lit pixels is "), std::string::npos)
      << result.errors;
}

TEST_F(ReportCommand, LeavesAPageAndTwoTables) {
  report("--only quantised");
  for (const char* name : {"report.html", "report.csv", "report.json", "needle.stl"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / name)) << name;
  }
}

TEST_F(ReportCommand, WhatGoesWrongLeavesNothing) {
  const std::size_t files = folder_.file_count();
  EXPECT_EQ(nacre("report ball.nii --only speed -o out").status, 2);
  EXPECT_EQ(nacre("report ball.nii --window 5,1 -o out").status, 2);
  EXPECT_EQ(nacre("report none.nii -o out").status, 3);
  EXPECT_EQ(nacre("report ball.nii --only quantised -o ball.nii").status, 2);
  EXPECT_EQ(folder_.file_count(), files);
}

TEST_F(ReportCommand, NamesAreQuotedInCommands) {
  ASSERT_EQ(nacre("phantom spheres --size 12,12,12 -o \"a 'b'.nii\"").status, 0);
  const CommandResult result = nacre(
      "report \"a 'b'.nii\" --window 0,28 --size 20x20 --turntable 1 --quick --only quantised "
      "-o 'o ut' -q --json -");
  ASSERT_EQ(result.status, 0) << result.errors;
  expect_repeatable(json::parse(result.output)["rows"]);
}

}  // namespace
}  // namespace nacre
