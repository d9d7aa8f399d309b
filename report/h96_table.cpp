#include "report/h96_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "render/display.h"
#include "report/markup.h"
#include "report/page_style.h"
#include "report/page_words.h"

namespace nacre {
namespace {

constexpr std::array<PictureMode, 2> kModes{PictureMode::Max, PictureMode::Sum};
constexpr int kThumbnail = 256;

std::string_view mode_words(PictureMode mode) {
  return mode == PictureMode::Max ? "maximum" : "summation";
}

const Measured* drawn(const H96Case& table_case, PictureMode mode) {
  const auto& rows = table_case.measured.rows;
  const auto found = std::ranges::find_if(rows, [&](const Measured& row) {
    return row.method.shells && row.left_out.empty() && row.method.subject.mode == mode;
  });
  return found == rows.end() ? nullptr : &*found;
}

double frames_per_second(const Measured& row) {
  return row.frame_seconds.median > 0.0 ? 1.0 / row.frame_seconds.median : 0.0;
}

/// The paper's frame rate of a row; empty where it is not at hand.
std::string paper_rate(const std::vector<H96Figure>& paper, const H96Case& table_case,
                       const Measured& row) {
  for (const H96Figure& figure : paper) {
    if (figure.data_set == table_case.data_set && figure.levels == table_case.levels &&
        figure.mode == mode_words(row.method.subject.mode)) {
      return fmt::format("{}", figure.frames_per_second);
    }
  }
  return "";
}

H96Figure parsed_figure(const std::string& line, const std::string& where) {
  std::istringstream fields(line);
  H96Figure figure;
  std::string levels;
  std::string rate;
  std::string more;
  std::getline(fields, figure.data_set, ',');
  std::getline(fields, levels, ',');
  std::getline(fields, figure.mode, ',');
  std::getline(fields, rate, ',');
  const auto number = [](const std::string& text, auto& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
  };
  const bool known = figure.mode == "maximum" || figure.mode == "summation";
  if (!known || std::getline(fields, more) || !number(levels, figure.levels) ||
      !number(rate, figure.frames_per_second) || !(figure.frames_per_second > 0.0)) {
    throw Error(ErrorCode::BadFile,
                fmt::format("{}: found '{}', expected a data set, its shells, maximum or summation "
                            "and frames a second",
                            where, line));
  }
  return figure;
}

std::string row_html(const H96Case& table_case, const std::vector<H96Figure>& paper,
                     const Measured& row) {
  std::string html = fmt::format(
      "<tr{}><td>{}, {} shells</td><td>{}, {}</td>", row.method.shells ? "" : " class=\"exact\"",
      escaped(table_case.data_set), table_case.levels, mode_words(row.method.subject.mode),
      row.method.shells ? escaped(row.method.backend) : std::string("exact walk"));
  if (!row.left_out.empty()) {
    return html + fmt::format("<td colspan=\"6\" class=\"out\">left out: {}</td></tr>\n",
                              escaped(row.left_out));
  }
  html += fmt::format("<td>{}</td><td>{:.3g}</td><td>{}</td><td>{}</td><td>{}</td>",
                      row.triangles > 0 ? count_words(row.triangles) : "", frames_per_second(row),
                      spread_words(row.frame_seconds, 1e-3), decibel_words(row.error.lit),
                      error_words(row.error.all.max_error));
  const std::string rate = paper_rate(paper, table_case, row);
  return html + fmt::format("<td>{}</td></tr>\n", rate.empty() ? "not at hand" : rate);
}

std::string pictures_html(const H96Case& table_case) {
  std::string html;
  for (const PictureMode mode : kModes) {
    if (drawn(table_case, mode) == nullptr) continue;
    html += fmt::format(
        "<figure><img alt=\"picture\" src=\"{}\"><figcaption>{}, {} shells, {}</figcaption>"
        "</figure>\n",
        data_uri(thumbnail(h96_picture(table_case, mode), kThumbnail)),
        escaped(table_case.data_set), table_case.levels, mode_words(mode));
  }
  return html;
}

std::string words(const std::vector<H96Case>& cases, bool has_paper, const MachineFacts& machine) {
  std::string html =
      "<p>Frame rates of maximum projection and summation after table 1 of W. Heidrich, "
      "<i>Hardware Accelerated Rendering of Emissive Volumes</i> (University of Erlangen, 1996): "
      "shells of the same kinds of data at the same numbers of levels, drawn here by each "
      "backend, with the error of each against the exact picture of the volume. ";
  html += has_paper
              ? "The figures of 1996 in the last column are the paper's, of its machine.</p>\n"
              : "The column for the figures of 1996 is empty: the paper's table was not at "
                "hand when this was written, and nothing is put in its place. Whoever has it "
                "fills the column with <code>--paper-figures FILE.csv</code>.</p>\n";
  html += "<ul>\n";
  for (const H96Case& table_case : cases) {
    html += fmt::format("<li>{}, {} shells: {}, {} samples</li>\n", escaped(table_case.data_set),
                        table_case.levels, escaped(table_case.source), escaped(table_case.samples));
  }
  return html + fmt::format(
                    "</ul>\n<p>{}, {} threads; {}; {}. {:.1f} threads ran on average in "
                    "the minute before.</p>\n",
                    escaped(machine.processor), machine.threads, escaped(machine.system),
                    escaped(machine.date), machine.load);
}

}  // namespace

std::vector<Method> h96_methods(std::size_t levels) {
  std::vector<Method> methods;
  for (const PictureMode mode : kModes) {
    const std::string part(mode == PictureMode::Max ? "max" : "sum");
    methods.push_back({.id = part + "-exact", .part = part, .subject = {.mode = mode}});
    for (const char* backend : {"cpu", "osmesa", "egl"}) {
      methods.push_back({.id = fmt::format("{}-{}", part, backend),
                         .part = part,
                         .subject = {.mode = mode},
                         .shells = ShellRecipe{{levels}},
                         .backend = backend});
    }
  }
  return methods;
}

std::vector<H96Figure> read_h96_figures(const std::string& csv, const std::string& name) {
  constexpr std::string_view kNames = "data_set,levels,mode,frames_per_s";
  std::vector<H96Figure> figures;
  std::istringstream lines(csv);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty() || (number == 1 && line == kNames)) continue;
    figures.push_back(parsed_figure(line, fmt::format("{}: line {}", name, number)));
  }
  return figures;
}

std::string h96_csv(const std::vector<H96Case>& cases, const std::vector<H96Figure>& paper) {
  std::string csv =
      "data_set,source,levels,mode,backend,left_out,triangles,frames_per_s,frame_s,psnr_lit_db,"
      "rmse_lit,max_error,frames_per_s_1996\r\n";
  for (const H96Case& table_case : cases) {
    for (const Measured& row : table_case.measured.rows) {
      csv +=
          fmt::format("\"{}\",\"{}\",{},{},{},", table_case.data_set, table_case.source,
                      table_case.levels, mode_words(row.method.subject.mode), row.method.backend);
      if (!row.left_out.empty()) {
        csv += fmt::format("\"{}\",,,,,,,\r\n", row.left_out);
        continue;
      }
      csv += fmt::format(",{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{}\r\n", row.triangles,
                         frames_per_second(row), row.frame_seconds.median, row.error.lit.psnr_db,
                         row.error.lit.rmse, row.error.all.max_error,
                         paper_rate(paper, table_case, row));
    }
  }
  return csv;
}

DisplayImage h96_picture(const H96Case& table_case, PictureMode mode) {
  const Measured* row = drawn(table_case, mode);
  if (row == nullptr) {
    throw Error(
        ErrorCode::Unsupported,
        fmt::format("{}: found no backend that draws it, expected one", table_case.data_set));
  }
  const Image& image = row->first_view.volume;
  return display_picture(image, default_display_window(image, mode));
}

std::string h96_page(const std::vector<H96Case>& cases, const std::vector<H96Figure>& paper,
                     const MachineFacts& machine) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<title>Table 1 of 1996, today</title>\n<style>{}</style></head><body><main>\n"
      "<h1>Table 1 of 1996, today</h1>\n",
      page_style());
  html += words(cases, !paper.empty(), machine);
  html +=
      "<div class=\"wide\"><table><thead><tr><th>data</th><th>method</th><th>triangles</th>"
      "<th>frames<br>a second</th><th>frame<br>ms</th><th>PSNR lit<br>dB</th><th>max error</th>"
      "<th>1996: frames<br>a second</th></tr></thead><tbody>\n";
  for (const H96Case& table_case : cases) {
    for (const Measured& row : table_case.measured.rows) html += row_html(table_case, paper, row);
  }
  html += "</tbody></table></div>\n<div class=\"pictures\">\n";
  for (const H96Case& table_case : cases) html += pictures_html(table_case);
  return html + "</div>\n</main></body></html>\n";
}

}  // namespace nacre
