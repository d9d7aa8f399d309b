// Rows of maxima by samples along rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "core/volume_geometry.h"
#include "datasets/phantom.h"
#include "report/measurement.h"
#include "report/needle.h"
#include "report/report_page.h"
#include "report/report_tables.h"

namespace nacre {
namespace {

/// Samples never find more than the exact walk, but for their rounding to floats.
constexpr double kRounding = 1e-6;

Method sampled(int samples, const Subject& subject = {}) {
  return {.id = "max-sampled-" + std::to_string(samples),
          .part = "max",
          .subject = subject,
          .samples = samples,
          .backend = "sampled"};
}

/// Exact, sampled and shells of the processor on a small volume.
class SampledRows : public ::testing::Test {
 protected:
  SampledRows() {
    const std::vector<std::string> only{"max"};
    options_.methods = report_methods({.only = only});
    std::erase_if(options_.methods, [](const Method& method) {
      return method.shells && (method.backend != "cpu" || method.shells->levels.uniform > 12);
    });
    options_.input_bytes = 1234;
    options_.read_seconds = 0.25;
    options_.most_passes = 2;
    const BoundingSphere sphere = bounding_sphere(volume_.dims, volume_.world_from_voxel);
    // Along an axis of the volume there is no error: the field is linear between its planes.
    for (const double azimuth : {0.3, 1.0}) {
      options_.cameras.push_back(
          make_camera({.size = {48, 40}, .azimuth_rad = azimuth, .elevation_rad = 0.4}, sphere));
    }
  }

  MeasurementResult run() const { return measure(volume_, emission_, options_); }

  const Volume volume_ = make_phantom("spheres", {.size = glm::i64vec3(12, 11, 10)});
  EmissionMap emission_ = EmissionMap::window(0.0, 28.0);
  MeasurementOptions options_;
};

const Measured& row_of(const MeasurementResult& result, const std::string& id) {
  const auto row = std::ranges::find_if(
      result.rows, [&](const Measured& measured) { return measured.method.id == id; });
  EXPECT_NE(row, result.rows.end()) << id;
  return *row;
}

TEST_F(SampledRows, MoreAreCloserAndOneAVoxelIsCloserThanSixShells) {
  const MeasurementResult result = run();
  double before = row_of(result, "max-6-cpu").error.lit.rmse;
  for (const int samples : {1, 2, 4}) {
    const PictureComparison& error = row_of(result, "max-sampled-" + std::to_string(samples)).error;
    EXPECT_GT(error.lit.rmse, 0.0) << samples;
    EXPECT_LT(error.lit.rmse, before) << samples;
    EXPECT_LT(error.lit.bias, kRounding) << "never above the exact ones";
    before = error.lit.rmse;
  }
}

TEST_F(SampledRows, AreMeasuredInTheMomentsOfTheExactWalk) {
  const MeasurementResult result = run();
  const Measured& exact = row_of(result, "max-exact");
  for (const Measured& row : result.rows) {
    if (!row.method.samples) continue;
    EXPECT_EQ(row.left_out, "");
    EXPECT_EQ(row.frame_seconds.samples, 8) << "two views beside two recipes in two passes";
    EXPECT_EQ(row.frame_seconds.samples, exact.frame_seconds.samples);
    EXPECT_GT(row.frame_seconds.median, 0.0);
    EXPECT_EQ(row.build_seconds.samples, 2);
    EXPECT_EQ(row.load_seconds.median, 0.25);
    EXPECT_EQ(row.bytes, 1234U);
    EXPECT_EQ(row.triangles, 0U);
    EXPECT_EQ(row.draw_peak_bytes.has_value(), exact.draw_peak_bytes.has_value());
    EXPECT_EQ(row.first_view.volume.width, 48);
    EXPECT_EQ(row.device, "samples of the trilinear field, single precision");
  }
}

TEST_F(SampledRows, ShowTheirSubjectsCueToolAndSlab) {
  const BoundingSphere sphere = bounding_sphere(volume_.dims, volume_.world_from_voxel);
  const std::vector<Tool> tools{{.name = "needle", .mesh = needle(sphere)}};
  const MeasurementResult plain = run();
  options_.tools = tools;
  options_.slab = {-2.0, 3.0};
  options_.methods = {sampled(16, {.cued = true, .with_tool = true})};
  const MeasurementResult result = run();
  const Measured& row = result.rows.front();
  EXPECT_LT(row.error.lit.rmse, row_of(plain, "max-sampled-4").error.lit.rmse);
  EXPECT_TRUE(row.first_view.tools);
}

TEST_F(SampledRows, UnderACueABentMapIsLeftOutWithTheReason) {
  emission_ = EmissionMap::piecewise_linear({{0.0, 0.0}, {10.0, 0.5}, {28.0, 1.0}});
  options_.methods = {sampled(2, {.cued = true}), sampled(2)};
  const MeasurementResult result = run();
  EXPECT_NE(result.rows.front().left_out.find("emission map of 2 pieces"), std::string::npos)
      << result.rows.front().left_out;
  EXPECT_EQ(result.rows.front().build_seconds.samples, 0);
  EXPECT_EQ(result.rows.back().left_out, "");
  EXPECT_EQ(result.rows.back().build_seconds.samples, 2);
}

TEST_F(SampledRows, PageSaysWhatTheyAre) {
  ReportContext context;
  const std::string page = report_page(run(), context);
  for (const char* words :
       {"<dt>Samples</dt>", "<td>1 sample a voxel</td>", "<td>4 samples a voxel</td>",
        "Samples at their fastest", "Samples at their closest: <b>max-sampled-4</b>",
        "sampled: samples along every ray", "--method sampled --samples 4"}) {
    EXPECT_NE(page.find(words), std::string::npos) << words;
  }
  std::erase_if(options_.methods, [](const Method& method) { return method.samples.has_value(); });
  const std::string without = report_page(run(), context);
  for (const char* words : {"<dt>Samples</dt>", "Samples at their", "sampled:"}) {
    EXPECT_EQ(without.find(words), std::string::npos) << words;
  }
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

TEST_F(SampledRows, TablesHaveTheNumberOfSamples) {
  const MeasurementResult result = run();
  const auto json = nlohmann::json::parse(report_json(result, {}));
  std::istringstream csv(report_csv(result));
  std::string line;
  std::getline(csv, line);
  const std::vector<std::string> names = fields(line);
  const auto column = static_cast<std::size_t>(std::ranges::find(names, "samples") - names.begin());
  ASSERT_LT(column, names.size());
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const Method& method = result.rows[i].method;
    std::getline(csv, line);
    EXPECT_EQ(fields(line).at(column), method.samples ? std::to_string(*method.samples) : "");
    EXPECT_EQ(json["rows"][i].value("samples", 0), method.samples.value_or(0));
  }
}

}  // namespace
}  // namespace nacre
