#include "report/error_growth.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace nacre {
namespace {

using nlohmann::json;

/// Errors this small are rounding: that of floats.
constexpr double kRounding = 1e-7;

struct Figure {
  const char* words;
  double now;
  double then;
};

void compare(const Measured& row, const json& then, double allowed,
             std::vector<std::string>& lines) {
  const json& error = then.at("error");
  const PictureComparison& now = row.error;
  for (const Figure& figure :
       {Figure{"RMSE over lit pixels", now.lit.rmse, error.at("lit").at("rmse").get<double>()},
        Figure{"RMSE over all pixels", now.all.rmse, error.at("all").at("rmse").get<double>()},
        Figure{"maximum error", now.all.max_error,
               error.at("all").at("max_error").get<double>()}}) {
    if (figure.now <= (1.0 + allowed) * figure.then + kRounding * now.peak) continue;
    lines.push_back(fmt::format("{}: {} is {:.4g}, was {:.4g} ({:.0f} % more)", row.method.id,
                                figure.words, figure.now, figure.then,
                                100.0 * (figure.now / figure.then - 1.0)));
  }
}

}  // namespace

std::vector<std::string> grown_errors(const MeasurementResult& result, std::string_view earlier,
                                      std::string_view name, double allowed) {
  std::vector<std::string> lines;
  try {
    const json report = json::parse(earlier);
    for (const json& then : report.at("rows")) {
      const auto id = then.at("id").get<std::string>();
      const auto row = std::ranges::find_if(
          result.rows, [&](const Measured& measured) { return measured.method.id == id; });
      if (row == result.rows.end() || then.contains("left_out")) continue;
      if (!row->left_out.empty()) {
        lines.push_back(fmt::format("{}: is left out, was measured: {}", id, row->left_out));
        continue;
      }
      compare(*row, then, allowed, lines);
    }
  } catch (const json::exception& error) {
    throw Error(ErrorCode::BadFile,
                fmt::format("{}: found {}, expected the JSON of a report", name, error.what()));
  }
  return lines;
}

}  // namespace nacre
