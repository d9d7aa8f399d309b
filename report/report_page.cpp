#include "report/report_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <vector>

#include "render/display.h"
#include "report/markup.h"
#include "report/page_style.h"
#include "report/page_words.h"
#include "report/scatter_plot.h"

namespace nacre {
namespace {

constexpr int kThumbnail = 288;  ///< pixels a side
/// Full colour in a difference is an error of this part of the peak.
constexpr double kFullColor = 1.0 / 16.0;

using Rows = std::vector<const Measured*>;

Rows rows_of(const MeasurementResult& result, std::string_view part) {
  Rows rows;
  for (const Measured& row : result.rows) {
    if (row.method.part == part) rows.push_back(&row);
  }
  return rows;
}

Rows measured(const Rows& rows) {
  Rows result;
  std::ranges::copy_if(rows, std::back_inserter(result),
                       [](const Measured* row) { return row->left_out.empty(); });
  return result;
}

std::vector<PlotSeries> series_of(const Rows& rows,
                                  const std::function<double(const Measured&)>& price) {
  std::vector<PlotSeries> series;
  for (const Measured* row : rows) {
    if (!(price(*row) > 0.0)) continue;  // unknown
    const std::string& name = row->method.backend;
    auto own = std::ranges::find(series, name, &PlotSeries::name);
    if (own == series.end()) {
      series.push_back({name, style_of(name), {}});
      own = series.end() - 1;
    }
    own->points.push_back(
        {price(*row), row->error.lit.psnr_db, plot_label(row->method), plot_title(*row)});
  }
  return series;
}

std::string plots(const Rows& rows) {
  std::set<ShellRecipe> recipes;
  for (const Measured* row : rows) {
    if (row->method.shells) recipes.insert(*row->method.shells);
  }
  std::string html = "<div class=\"plots\">\n";
  html += to_svg({"Error against frame time", "milliseconds a frame", 1e-3,
                  series_of(rows, [](const Measured& row) { return row.frame_seconds.median; })});
  if (recipes.size() > 1) {  // else all have one price
    html += to_svg(
        {"Error against file size", "kilobytes", 1e3, series_of(rows, [](const Measured& row) {
           return is_sampled(row.method)
                      ? 0.0
                      : static_cast<double>(row.bytes);  // the walk stands for it
         })});
    html += to_svg({"Error against build time", "milliseconds", 1e-3,
                    series_of(rows, [](const Measured& row) { return row.build_seconds.median; })});
  }
  html += "</div>\n<p class=\"legend\">";
  std::set<std::string> shown;
  for (const Measured* row : rows) {
    const std::string& backend = row->method.backend;
    if (!shown.insert(backend).second) continue;
    html += fmt::format("<span>{}{}</span> ", legend_mark(style_of(backend)),
                        escaped(backend_words(backend)));
  }
  return html + "</p>\n";
}

std::string table_head() {
  return "<div class=\"wide\"><table><thead><tr><th>row</th><th>method</th>"
         "<th>triangles</th><th>PSNR lit<br>dB</th><th>RMSE lit</th><th>max error</th>"
         "<th>PSNR all<br>dB</th><th>RMSE all</th><th>frame<br>ms</th><th>build<br>s</th>"
         "<th>load<br>ms</th><th>file<br>MB</th><th>memory to<br>build, MB</th>"
         "<th>memory to<br>draw, MB</th></tr></thead><tbody>\n";
}

std::string table_row(const Measured& row) {
  std::string html =
      fmt::format("<tr{}><td><a href=\"#how-{}\">{}</a></td><td>{}</td>",
                  is_exact(row.method) ? " class=\"exact\"" : "", escaped(row.method.id),
                  escaped(row.method.id), escaped(method_words(row.method)));
  if (!row.left_out.empty()) {
    return html + fmt::format("<td colspan=\"12\" class=\"out\">left out: {}</td></tr>\n",
                              escaped(row.left_out));
  }
  const auto cell = [&](const std::string& text) { html += fmt::format("<td>{}</td>", text); };
  cell(row.triangles > 0 ? count_words(row.triangles) : "");
  cell(decibel_words(row.error.lit));
  cell(error_words(row.error.lit.rmse));
  cell(error_words(row.error.all.max_error));
  cell(decibel_words(row.error.all));
  cell(error_words(row.error.all.rmse));
  cell(spread_words(row.frame_seconds, 1e-3));
  cell(spread_words(row.build_seconds, 1.0));
  cell(spread_words(row.load_seconds, 1e-3));
  cell(fmt::format("{:.2f}", 1e-6 * static_cast<double>(row.bytes)));
  cell(megabyte_words(row.build_peak_bytes));
  cell(megabyte_words(row.draw_peak_bytes));
  return html + "</tr>\n";
}

std::string table(const Rows& rows) {
  std::string html = table_head();
  for (const Measured* row : rows) html += table_row(*row);
  return html + "</tbody></table></div>\n";
}

const Truth& truth_of(const MeasurementResult& result, const Subject& subject) {
  return *std::ranges::find(result.truths, subject, &Truth::subject);
}

/// What the truth lights of a picture, small.
std::string small_uri(const DisplayImage& picture, const Truth& truth) {
  const PictureCrop part = lit_part(truth.first_view.volume, truth.peak);
  return data_uri(thumbnail(cropped(picture, part), kThumbnail));
}

std::string shown(const Picture& picture, const Truth& truth) {
  DisplayOptions options;
  options.mode = truth.subject.mode;
  options.window = default_display_window(static_cast<float>(truth.peak), truth.subject.mode);
  return fmt::format("<img alt=\"picture\" src=\"{}\">",
                     small_uri(display_picture(picture, options), truth));
}

std::string pictures(const MeasurementResult& result, const Rows& rows) {
  std::string html = "<div class=\"pictures\">\n";
  for (const Measured* row : rows) {
    const Truth& truth = truth_of(result, row->method.subject);
    html += "<figure>" + shown(row->first_view, truth);
    if (!is_exact(row->method)) {
      const Image error = difference(row->first_view.volume, truth.first_view.volume);
      const DisplayImage colors = difference_picture(error, 1.0 / (kFullColor * truth.peak));
      html += fmt::format("<img alt=\"difference from the exact picture\" src=\"{}\">",
                          small_uri(colors, truth));
    }
    html +=
        fmt::format("<figcaption>{}<br>{}</figcaption></figure>\n", escaped(row->method.id),
                    is_exact(row->method) ? std::string("the exact picture")
                                          : decibel_words(row->error.lit) + " dB over lit pixels");
  }
  return html + "</div>\n";
}

std::string commands(const Rows& rows, const CommandTexts& texts) {
  std::string html = "<details><summary>The commands that repeat each row</summary>\n";
  for (const Measured* row : rows) {
    html += fmt::format("<h4 id=\"how-{0}\">{0}</h4><pre>", escaped(row->method.id));
    for (const std::string& line : command_lines(row->method, texts)) html += escaped(line) + "\n";
    html += "</pre>\n";
  }
  return html + "</details>\n";
}

std::string section(const MeasurementResult& result, const ReportPart& part,
                    const ReportContext& context) {
  const Rows rows = rows_of(result, part.name);
  const Rows done = measured(rows);
  if (rows.empty()) return "";
  std::string html = fmt::format("<section id=\"{}\"><h2>{}</h2>\n<p>{}</p>\n", part.name,
                                 escaped(part.title), escaped(part.what));
  html += outcome_words(done);
  html += plots(done) + table(rows);
  html +=
      "<details open><summary>The pictures of the first view, each with its difference from "
      "the exact one</summary>\n" +
      pictures(result, done) + "</details>\n";
  return html + commands(rows, context.commands) + "</section>\n";
}

std::string contents(const MeasurementResult& result) {
  std::string html = "<nav>";
  for (const ReportPart& part : report_parts()) {
    if (rows_of(result, part.name).empty()) continue;
    html += fmt::format("<a href=\"#{}\">{}</a> ", part.name, escaped(part.title));
  }
  return html + "</nav>\n";
}

}  // namespace

std::string report_page(const MeasurementResult& result, const ReportContext& context) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<title>{0}: error against run time</title>\n<style>{1}</style></head><body><main>\n"
      "<h1>{0}: error against run time</h1>\n",
      escaped(context.volume), page_style());
  html += opening_words(result, context);
  html += contents(result);
  for (const ReportPart& part : report_parts()) html += section(result, part, context);
  html += closing_words(result, context);
  return html + "</main></body></html>\n";
}

}  // namespace nacre
