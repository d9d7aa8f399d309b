#include "report/page_words.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "report/markup.h"

namespace nacre {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kBackends{{
    {"exact", "exact walk: every ray through the volume itself"},
    {"cpu", "cpu: shells drawn by the processor alone"},
    {"osmesa", "osmesa: shells drawn by OpenGL in software (OSMesa)"},
    {"egl", "egl: shells drawn by OpenGL (EGL)"},
    {"vtk-fixed", "vtk-fixed: the volume drawn by VTK's ray caster on the processor"},
    {"vtk-gpu", "vtk-gpu: the volume drawn by VTK's ray caster in OpenGL (EGL)"},
    {"sampled", "sampled: samples along every ray through the volume itself"},
}};

bool has_shells(const Measured& row) { return row.method.shells.has_value(); }
bool has_peer(const Measured& row) { return row.method.peer.has_value(); }
bool has_samples(const Measured& row) { return row.method.samples.has_value(); }

/// The row of the kind with the least price; null if there is none.
const Measured* least(const std::vector<const Measured*>& rows, bool (*kind)(const Measured&),
                      double (*price)(const Measured&)) {
  const Measured* best = nullptr;
  for (const Measured* row : rows) {
    if (kind(*row) && (best == nullptr || price(*row) < price(*best))) best = row;
  }
  return best;
}

double frame_price(const Measured& row) { return row.frame_seconds.median; }
double byte_price(const Measured& row) { return static_cast<double>(row.bytes); }
double error_price(const Measured& row) { return row.error.lit.rmse; }

std::string row_words(std::string_view praise, const Measured& row) {
  return fmt::format("<li>{}: <b>{}</b>, {} ms a frame, {} dB, {:.2f} MB.</li>\n", praise,
                     escaped(row.method.id), figure_words(1e3 * row.frame_seconds.median),
                     decibel_words(row.error.lit), 1e-6 * static_cast<double>(row.bytes));
}

std::string definition(std::string_view term, const std::string& text) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", term, text);
}

/// What rows of samples are, where there are any.
std::string sample_words(const MeasurementResult& result) {
  if (std::ranges::none_of(result.rows, has_samples)) return "";
  return definition(
      "Samples",
      "Looks at the volume in a number of places a voxel along the ray of every pixel, and shows "
      "the brightest of them: too dark wherever the brightest point lies between two. "
      "Where rays run along an axis of the volume, as in the first view of most turntables, there "
      "is no such error: values are linear from voxel to voxel there.");
}

/// What VTK's rows are, where there are any.
std::string peer_words(const MeasurementResult& result) {
  if (std::ranges::none_of(result.rows, has_peer)) return "";
  return definition(
      "VTK",
      "The Visualization Toolkit, what most programs draw volumes with: it takes "
      "samples along each ray at a fixed distance, the step, here given in voxels (the "
      "mean of the three spacings). A program of its own draws them beside this one, in "
      "turn with the rest.");
}

}  // namespace

std::string method_words(const Method& method) {
  if (method.peer) {
    return fmt::format("VTK, step {}, {}", method.peer->step,
                       method.peer->caster == "gpu" ? "OpenGL" : "processor");
  }
  if (method.samples) {
    return fmt::format("{} {} a voxel", *method.samples,
                       *method.samples == 1 ? "sample" : "samples");
  }
  if (!method.shells) {
    const std::string at =
        method.subject.mode == PictureMode::Count || method.subject.mode == PictureMode::Iso
            ? fmt::format(", levels {}", text_of(method.subject.levels))
            : "";
    return "exact walk" + at;
  }
  const ShellRecipe& shells = *method.shells;
  std::string words = shells.levels.uniform > 0 ? fmt::format("{} levels", shells.levels.uniform)
                                                : fmt::format("level {}", text_of(shells.levels));
  if (shells.tolerance > 0.0) words += fmt::format(", tolerance {}", shells.tolerance);
  if (shells.quantization_bits > 0) words += fmt::format(", {} bits", shells.quantization_bits);
  words += ", " + method.backend;
  if (method.part == "depth") words += fmt::format(", depth {}", name(method.depth));
  if (method.part == "target") words += fmt::format(", target {}", name(method.target));
  if (method.part == "occlusion") words += fmt::format(", by {}", name(method.occlusion));
  return words;
}

std::string backend_words(const std::string& backend) {
  for (const auto& [name, words] : kBackends) {
    if (name == backend) return std::string(words);
  }
  return backend;
}

int style_of(const std::string& backend) {
  const auto found =
      std::ranges::find_if(kBackends, [&](const auto& entry) { return entry.first == backend; });
  return static_cast<int>(found - kBackends.begin());
}

std::string plot_label(const Method& method) {
  if (method.peer) return fmt::format("{}", method.peer->step);
  if (method.samples) return fmt::format("{}", *method.samples);
  if (!method.shells) return "exact walk";
  if (method.part == "simplified") return fmt::format("{}", method.shells->tolerance);
  if (method.part == "quantised") {
    const int bits = method.shells->quantization_bits;
    return bits > 0 ? fmt::format("{} bits", bits) : "chosen";
  }
  if (method.part == "iso") {
    const double tolerance = method.shells->tolerance;
    return tolerance > 0.0 ? fmt::format("{}", tolerance) : "all";
  }
  if (method.part == "occlusion") return std::string(name(method.occlusion));
  if (method.part == "depth") return std::string(name(method.depth));
  if (method.part == "target") return std::string(name(method.target));
  return text_of(method.shells->levels);
}

std::string plot_title(const Measured& row) {
  std::string words = fmt::format("{}: {} dB, {:.3g} ms a frame, {:.2f} MB", row.method.id,
                                  decibel_words(row.error.lit), 1e3 * row.frame_seconds.median,
                                  1e-6 * static_cast<double>(row.bytes));
  if (row.build_seconds.samples > 0) {
    words += fmt::format(", built in {:.3g} s", row.build_seconds.median);
  }
  return words;
}

std::string count_words(std::size_t count) {
  if (count < 1000) return fmt::format("{}", count);
  constexpr const char* kNarrowSpace = "&#8239;";
  return fmt::format("{}{}{:03}", count_words(count / 1000), kNarrowSpace, count % 1000);
}

std::string decibel_words(const PictureError& error) {
  return std::isfinite(error.psnr_db) ? fmt::format("{:.1f}", error.psnr_db) : "exact";
}

std::string error_words(double error) {
  return error == 0.0 ? std::string("0") : fmt::format("{:.3g}", error);
}

std::string figure_words(double figure) {
  constexpr double kFourDigits = 999.5;  // 1e+03 is no way to write a thousand
  return figure < kFourDigits ? fmt::format("{:.3g}", figure) : fmt::format("{:.0f}", figure);
}

std::string spread_words(const Spread& spread, double unit) {
  if (spread.samples == 0) return "&ndash;";
  const std::string median = figure_words(spread.median / unit);
  if (spread.samples == 1) return median;
  return fmt::format("{} <small>({} to {})</small>", median, figure_words(spread.lower / unit),
                     figure_words(spread.upper / unit));
}

std::string megabyte_words(const std::optional<std::size_t>& bytes) {
  return bytes ? fmt::format("{:.0f}", 1e-6 * static_cast<double>(*bytes)) : "&ndash;";
}

std::string outcome_words(const std::vector<const Measured*>& rows) {
  std::string html = "<ul>\n";
  for (const Measured* row : rows) {
    if (!is_exact(row->method)) continue;
    html += fmt::format(
        "<li>Without any error: <b>{}</b>, {:.3g} ms a frame, from the volume's "
        "{:.2f} MB.</li>\n",
        escaped(row->method.id), 1e3 * row->frame_seconds.median,
        1e-6 * static_cast<double>(row->bytes));
  }
  if (const Measured* sampled = least(rows, has_samples, frame_price)) {
    html += row_words("Samples at their fastest", *sampled);
    html += row_words("Samples at their closest", *least(rows, has_samples, error_price));
  }
  if (const Measured* peer = least(rows, has_peer, frame_price)) {
    html += row_words("VTK at its fastest", *peer);
    html += row_words("VTK at its closest", *least(rows, has_peer, error_price));
  }
  const Measured* fastest = least(rows, has_shells, frame_price);
  if (fastest == nullptr) return html + "</ul>\n";
  html += row_words("Fastest shells", *fastest);
  html += row_words("Smallest file", *least(rows, has_shells, byte_price));
  html += row_words("Closest shells", *least(rows, has_shells, error_price));
  return html + "</ul>\n";
}

std::string opening_words(const MeasurementResult& result, const ReportContext& context) {
  std::string html =
      "<p><b>How close to the truth is each way of drawing this scan, and what does it cost?</b> "
      "The scan can be drawn as it is, or as surfaces made of it beforehand; from left to right in "
      "each plot pictures get slower or files larger, from bottom to top they get better.</p>\n";
  html += fmt::format(
      "<p>{}; emission rises over the values {}. Each method drew the same {}; {} {} over all "
      "methods in turn, {:.0f} s in all.</p>\n",
      escaped(context.samples), escaped(context.window), escaped(context.views), result.passes,
      result.passes == 1 ? "pass" : "passes", result.seconds);
  html +=
      "<details open><summary>How to read this page</summary><dl>\n" +
      definition("Emission",
                 "What a point of the volume shines with, from 0 (dark) to 1 (full): a "
                 "window of the scan's values.") +
      definition("Exact walk",
                 "Follows the ray of every pixel through the volume and finds its maximum or its "
                 "integral in closed form. It is the truth that all else is compared with, and a "
                 "way of drawing like the others, with a run time of its own.") +
      definition("Shells",
                 "Closed surfaces at a number of emission levels, made of triangles once and drawn "
                 "from any side, without the volume.") +
      sample_words(result) + peer_words(result) +
      definition("PSNR, RMSE",
                 "How far a picture is from the exact one: the root of the mean squared "
                 "difference, and the same on a logarithmic scale against the brightest possible "
                 "pixel. 6 dB more is half the error. <i>Lit</i> pixels are those where the exact "
                 "picture shows anything; the black rest flatters the figure over all pixels.") +
      definition("The plots",
                 "Up is closer to the truth, left is cheaper. A full mark is a method that no "
                 "other beats in both; hollow marks are beaten.") +
      definition("Times", "Medians, with the middle half of all measurements in brackets.") +
      definition("Differences",
                 "Red where a picture is too bright, blue where it is too dark; full "
                 "colour is an error of a sixteenth of the peak.") +
      "</dl></details>\n";
  return html;
}

std::string closing_words(const MeasurementResult& result, const ReportContext& context) {
  const MachineFacts& machine = context.machine;
  std::string html = "<section id=\"machine\"><h2>How and where it was measured</h2><dl>\n";
  html += definition(
      "Program", fmt::format("Nacre {}, {}{}", escaped(context.version), escaped(machine.compiler),
                             machine.checked_build ? ", <b>a build with assertions: slow</b>"
                                                   : ", release build"));
  html += definition(
      "Machine",
      fmt::format("{}, {} threads, {:.1f} GB; {}", escaped(machine.processor), machine.threads,
                  1e-9 * static_cast<double>(machine.memory_bytes), escaped(machine.system)));
  std::vector<std::string> devices;
  for (const Measured& row : result.rows) {
    const std::string words = row.method.backend + ": " + row.device;
    if (!row.device.empty() && std::ranges::find(devices, words) == devices.end()) {
      devices.push_back(words);
    }
  }
  std::string list;
  for (const std::string& device : devices) list += escaped(device) + "<br>";
  html += definition("Drawn by", list);
  html += definition("When", fmt::format("{}; {:.1f} threads of this and other programs ran on "
                                         "average in the minute before: times are worth what "
                                         "that leaves",
                                         escaped(machine.date), machine.load));
  html +=
      definition("Build time",
                 "From the volume in memory to the bytes of the shell file. For the exact walk: "
                 "the table of brick maxima that lets it skip what cannot matter; for samples that "
                 "and a copy of what is bright.");
  html += definition("Load time",
                     "From the file's bytes to a renderer that is ready: decoding and "
                     "handing over. For the exact walk and samples: reading the volume.");
  html += definition("Memory",
                     "What the step adds at most to the program's resident memory. "
                     "Building: with a copy of the volume. Drawing: with the OpenGL "
                     "driver, if it was not loaded before; for the exact walk and samples "
                     "without the volume.");
  html += definition("This page again", "<pre>" + escaped(context.repeats_it) + "</pre>");
  return html + "</dl></section>\n";
}

}  // namespace nacre
