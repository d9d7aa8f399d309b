#include "report/measurement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/error.h"
#include "core/volume_geometry.h"
#include "datasets/phantom.h"
#include "report/error_growth.h"
#include "report/needle.h"
#include "report/report_page.h"
#include "report/report_tables.h"
#include "tests/support/expect_error.h"

namespace nacre {
namespace {

std::vector<Method> cpu_methods() {
  const std::vector<std::string> only{"simplified", "quantised"};
  return report_methods({.quick = true, .only = only});
}

/// A small measurement, without OpenGL.
class SmallMeasurement : public ::testing::Test {
 protected:
  SmallMeasurement() {
    options_.methods = cpu_methods();
    const BoundingSphere sphere = bounding_sphere(volume_.dims, volume_.world_from_voxel);
    options_.cameras = {make_camera({.size = {24, 20}}, sphere),
                        make_camera({.size = {24, 20}, .azimuth_rad = 1.0}, sphere)};
    options_.most_passes = 2;
  }

  MeasurementResult run() const { return measure(volume_, emission_, options_); }

  const Volume volume_ = make_phantom("spheres", {.size = glm::i64vec3(12, 11, 10)});
  const EmissionMap emission_ = EmissionMap::window(0.0, 28.0);
  MeasurementOptions options_;
};

TEST(ReportMethods, HaveIdsOfTheirOwnAndKnownParts) {
  for (const bool quick : {true, false}) {
    std::set<std::string> ids;
    for (const Method& method : report_methods({.quick = quick, .with_peers = true})) {
      EXPECT_TRUE(ids.insert(method.id).second) << method.id;
      EXPECT_TRUE(std::ranges::any_of(report_parts(), [&](const ReportPart& part) {
        return part.name == method.part;
      })) << method.part;
    }
  }
}

TEST(ReportMethods, EveryPartHasTheExactWalkOfEachSubject) {
  const std::vector<Method> methods = report_methods({});
  for (const Method& method : methods) {
    EXPECT_TRUE(std::ranges::any_of(methods, [&](const Method& exact) {
      return is_exact(exact) && exact.part == method.part && exact.subject == method.subject;
    })) << method.id;
  }
}

TEST(ReportMethods, SamplesComeAfterTheExactMaximumBeforePeersAndShells) {
  const std::vector<std::string> only{"max"};
  for (const bool quick : {true, false}) {
    const std::vector<Method> methods =
        report_methods({.quick = quick, .with_peers = true, .only = only});
    EXPECT_TRUE(is_exact(methods.front()));
    const std::vector<int> numbers = quick ? std::vector<int>{1, 2} : std::vector<int>{1, 2, 4};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const Method& method = methods.at(1 + i);
      EXPECT_EQ(method.id, "max-sampled-" + std::to_string(numbers[i]));
      EXPECT_EQ(method.samples, numbers[i]);
      EXPECT_EQ(method.backend, "sampled");
      EXPECT_FALSE(is_exact(method));
    }
    EXPECT_TRUE(methods.at(1 + numbers.size()).peer);
  }
}

TEST(ReportMethods, SamplesNeedNoPeers) {
  const std::vector<Method> methods = report_methods({.quick = true});
  EXPECT_EQ(std::ranges::count_if(methods, [](const Method& m) { return m.samples.has_value(); }),
            2);
}

TEST(ReportMethods, RefuseUnknownParts) {
  const std::vector<std::string> only{"max", "speed"};
  testing::expect_error(ErrorCode::BadArgument, "'speed', expected some of max,",
                        [&] { report_methods({.quick = true, .only = only}); });
}

TEST_F(SmallMeasurement, EveryRowHasItsFiguresAndTheWalkNoError) {
  const MeasurementResult result = run();
  EXPECT_EQ(result.passes, 2);
  ASSERT_EQ(result.rows.size(), options_.methods.size());
  for (const Measured& row : result.rows) {
    EXPECT_EQ(row.left_out, "") << row.method.id;
    EXPECT_EQ(row.error.all.pixels, 2U * 24U * 20U);
    EXPECT_EQ(row.error.all.rmse == 0.0, !row.method.shells) << row.method.id;
    EXPECT_EQ(row.build_seconds.samples, 2);
    EXPECT_EQ(row.frame_seconds.samples % 4, 0) << "two views, two passes";
    EXPECT_EQ(row.first_view.volume.width, 24);
    EXPECT_EQ(row.triangles > 0, row.method.shells.has_value()) << row.method.id;
  }
}

/// Draws gray pictures; its GPU does not.
class GrayPeer final : public PeerRenderer {
 public:
  PeerFrame draw(const PeerRecipe& recipe, std::size_t /*view*/) override {
    ++draws;
    if (recipe.caster == "gpu") throw Error(ErrorCode::Unsupported, "no GPU");
    PeerFrame frame{make_image(24, 20), 0.001, "gray paint"};
    for (float& pixel : frame.picture.pixels) pixel = 0.5F;
    return frame;
  }

  int draws = 0;
};

TEST_F(SmallMeasurement, PeersTakeTheirTurnsAndAreJudgedAlike) {
  GrayPeer gray;
  const std::vector<std::string> only{"quantised"};
  options_.methods = report_methods({.quick = true, .only = only});
  for (const char* caster : {"fixed", "gpu"}) {
    options_.methods.push_back({.id = caster,
                                .part = "quantised",
                                .peer = PeerRecipe{caster, 0.5},
                                .backend = std::string("vtk-") + caster});
  }
  options_.peers = &gray;
  const MeasurementResult result = run();
  const Measured& fixed = result.rows[result.rows.size() - 2];
  EXPECT_EQ(fixed.left_out, "");
  EXPECT_EQ(fixed.device, "gray paint");
  EXPECT_EQ(fixed.frame_seconds.samples, 8) << "two views beside two recipes in two passes";
  EXPECT_EQ(fixed.frame_seconds.median, 0.001);
  EXPECT_EQ(fixed.build_seconds.samples, 0);
  EXPECT_EQ(fixed.error.all.max_error, 0.5) << "over black and over what shines fully";
  EXPECT_EQ(result.rows.back().left_out, "no GPU");
  EXPECT_EQ(gray.draws, 2 + 1 + 8);
}

TEST_F(SmallMeasurement, WithoutPeersTheirRowsAreLeftOut) {
  options_.methods = {{.id = "vtk", .part = "max", .peer = PeerRecipe{}, .backend = "vtk-fixed"}};
  EXPECT_EQ(run().rows.front().left_out, "VTK's program did not start");
}

TEST_F(SmallMeasurement, ErrorsAreTheSameEachTime) {
  const MeasurementResult a = run();
  const MeasurementResult b = run();
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    EXPECT_EQ(a.rows[i].error.lit.rmse, b.rows[i].error.lit.rmse) << a.rows[i].method.id;
  }
}

TEST_F(SmallMeasurement, StopsAtItsBudgetAfterOnePassAtLeast) {
  options_.budget_seconds = 0.0;
  EXPECT_EQ(run().passes, 1);
}

TEST_F(SmallMeasurement, WhatABackendRefusesIsLeftOutWithTheReason) {
  const LevelChoice half{.uniform = 0, .single = 0.5};
  options_.methods = {{.id = "iso",
                       .part = "iso",
                       .subject = {.mode = PictureMode::Iso, .levels = half},
                       .shells = ShellRecipe{half},
                       .backend = "cpu"}};
  const MeasurementResult result = run();
  EXPECT_NE(result.rows.front().left_out, "");
  EXPECT_EQ(result.rows.front().frame_seconds.samples, 0);
}

TEST_F(SmallMeasurement, TheProcessorsSumsAndCountsAreMeasured) {
  const std::vector<std::string> only{"sum", "count"};
  options_.methods = report_methods({.quick = true, .only = only});
  std::erase_if(options_.methods, [](const Method& method) {
    return method.backend != "cpu" && method.backend != "exact";
  });
  std::set<std::string> drawn;
  for (const Measured& row : run().rows) {
    EXPECT_EQ(row.left_out, "") << row.method.id;
    if (row.method.shells) drawn.insert(row.method.id);
  }
  EXPECT_EQ(drawn, (std::set<std::string>{"count-12-cpu", "sum-12-cpu", "sum-24-cpu"}));
}

TEST_F(SmallMeasurement, PageStandsAloneAndNamesEveryRow) {
  const MeasurementResult result = run();
  ReportContext context;
  context.volume = "<spheres>.nrrd";
  context.commands = {.volume = "spheres.nrrd", .camera = "--turntable 2", .tools = "", .cue = {}};
  const std::string page = report_page(result, context);
  for (const char* foreign : {"http:", "https:", "<script", "<link", "@import", "<spheres>"}) {
    EXPECT_EQ(page.find(foreign), std::string::npos) << foreign;
  }
  for (const Measured& row : result.rows) {
    EXPECT_NE(page.find("id=\"how-" + row.method.id + "\""), std::string::npos) << row.method.id;
  }
}

TEST_F(SmallMeasurement, TablesHoldTheSameRows) {
  const MeasurementResult result = run();
  const auto json = nlohmann::json::parse(report_json(result, {}));
  ASSERT_EQ(json["rows"].size(), result.rows.size());
  const std::string csv = report_csv(result);
  EXPECT_EQ(std::ranges::count(csv, '\n'), static_cast<std::ptrdiff_t>(result.rows.size()) + 1);
  // No field of these rows has a comma of its own but what drew, which is quoted.
  const std::string head = csv.substr(0, csv.find("\r\n"));
  const std::size_t second = head.size() + 2;
  std::string line = csv.substr(second, csv.find("\r\n", second) - second);
  if (const auto quote = line.find('"'); quote != std::string::npos) line.resize(quote);
  EXPECT_EQ(std::ranges::count(line, ','), std::ranges::count(head, ','));
}

TEST_F(SmallMeasurement, AnErrorThatGrowsByMoreThanATenthIsNamed) {
  MeasurementResult result = run();
  const std::string earlier = report_json(result, {});
  EXPECT_TRUE(grown_errors(result, earlier, "earlier").empty());
  Measured& row = result.rows.back();
  row.error.lit.rmse *= 1.09;
  EXPECT_TRUE(grown_errors(result, earlier, "earlier").empty());
  row.error.lit.rmse *= 1.02;
  const std::vector<std::string> lines = grown_errors(result, earlier, "earlier");
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines.front().rfind(row.method.id + ": RMSE over lit pixels is ", 0), 0U)
      << lines.front();
}

TEST_F(SmallMeasurement, WhatIsNoReportIsRefusedAsAnEarlierOne) {
  const MeasurementResult result = run();
  for (const char* text : {"", "{}", R"({"rows":[{"id":1}]})", R"({"rows":3})"}) {
    testing::expect_error(ErrorCode::BadFile, "expected the JSON of a report",
                          [&] { grown_errors(result, text, "earlier.json"); });
  }
}

TEST(Needle, IsClosedAndRunsThroughTheCentre) {
  const BoundingSphere sphere{{10.0, -20.0, 30.0}, 50.0};
  const TriangleMesh mesh = needle(sphere);
  std::set<std::pair<unsigned, unsigned>> edges;
  for (const glm::uvec3& t : mesh.triangles) {
    for (const auto& [a, b] : {std::pair{t.x, t.y}, {t.y, t.z}, {t.z, t.x}}) {
      EXPECT_TRUE(edges.insert({a, b}).second) << "each directed edge once";
    }
  }
  for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a}));
  EXPECT_EQ(stl_bytes(mesh).size(), 84U + 50U * mesh.triangles.size());
}

}  // namespace
}  // namespace nacre
