#include "report/scatter_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "report/markup.h"

namespace nacre {
namespace {

constexpr double kWidth = 460.0;
constexpr double kHeight = 340.0;
constexpr double kLeft = 52.0;
constexpr double kRight = 26.0;
constexpr double kBandTop = 34.0;  ///< of the band for what has no error
constexpr double kTop = 66.0;      ///< of the PSNR axis
constexpr double kBottom = 48.0;

/// Told apart also by the colour-blind (M. Okabe, K. Ito, 2008).
constexpr std::array<const char*, 7> kColors{"#222222", "#0072b2", "#d55e00", "#009e73",
                                             "#aa4499", "#8a6d00", "#3d9bd1"};

struct Range {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();

  void take(double value) {
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
  bool empty() const { return lo > hi; }
};

/// Where prices and qualities lie in the picture.
struct Frame {
  Range log_price;
  Range quality;

  double x(double price) const {
    const double place = (std::log10(price) - log_price.lo) / (log_price.hi - log_price.lo);
    return kLeft + place * (kWidth - kLeft - kRight);
  }
  double y(double value) const {
    if (std::isinf(value)) return 0.5 * (kBandTop + kTop) - 4.0;
    const double place = (value - quality.lo) / (quality.hi - quality.lo);
    return kHeight - kBottom - place * (kHeight - kBottom - kTop);
  }
};

Frame frame_of(const ScatterPlot& plot) {
  Frame frame;
  for (const PlotSeries& series : plot.series) {
    for (const PlotPoint& point : series.points) {
      frame.log_price.take(std::log10(point.price));
      if (std::isfinite(point.quality)) frame.quality.take(point.quality);
    }
  }
  if (frame.quality.empty()) frame.quality = {0.0, 1.0};
  constexpr double kMargin = 0.12;  // decades, so that marks and their words stay inside
  frame.log_price.lo -= kMargin;
  frame.log_price.hi += kMargin + 0.12;
  constexpr double kStep = 5.0;  // dB
  frame.quality.lo = kStep * std::floor((frame.quality.lo - 0.5) / kStep);
  frame.quality.hi = kStep * std::ceil((frame.quality.hi + 0.5) / kStep);
  return frame;
}

/// Digits of the ticks within a decade, by how many decades there are.
std::span<const double> tick_digits(double decades) {
  static constexpr std::array<double, 10> kFine{1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0};
  static constexpr std::array<double, 3> kUsual{1.0, 2.0, 5.0};
  if (decades > 2.5) return std::span(kUsual).first(1);
  if (decades > 0.8) return kUsual;
  return kFine;
}

/// Round numbers within the frame: 1, 2 and 5 times powers of ten, fewer or more where those would
/// be many or hardly any.
std::vector<double> price_ticks(const Frame& frame, double unit) {
  const double lo = frame.log_price.lo - std::log10(unit);
  const double hi = frame.log_price.hi - std::log10(unit);
  std::vector<double> ticks;
  for (int decade = static_cast<int>(std::floor(lo)); decade <= std::ceil(hi); ++decade) {
    for (const double digit : tick_digits(hi - lo)) {
      const double tick = digit * std::pow(10.0, decade);
      if (std::log10(tick) >= lo && std::log10(tick) <= hi) ticks.push_back(tick * unit);
    }
  }
  return ticks;
}

std::string axes(const ScatterPlot& plot, const Frame& frame) {
  const double right = kWidth - kRight;
  const double bottom = kHeight - kBottom;
  std::string svg;
  for (const double tick : price_ticks(frame, plot.price_unit)) {
    svg +=
        fmt::format(R"(<line class="grid" x1="{0:.1f}" x2="{0:.1f}" y1="{1}" y2="{2}"/>)"
                    R"(<text class="tick" x="{0:.1f}" y="{3}" text-anchor="middle">{4:.6g}</text>)",
                    frame.x(tick), kBandTop, bottom, bottom + 16.0, tick / plot.price_unit);
  }
  const double step = frame.quality.hi - frame.quality.lo > 30.0 ? 10.0 : 5.0;
  for (double tick = step * std::ceil(frame.quality.lo / step); tick <= frame.quality.hi;
       tick += step) {
    svg += fmt::format(R"(<line class="grid" x1="{0}" x2="{1}" y1="{2:.1f}" y2="{2:.1f}"/>)"
                       R"(<text class="tick" x="{3}" y="{4:.1f}" text-anchor="end">{5:g}</text>)",
                       kLeft, right, frame.y(tick), kLeft - 6.0, frame.y(tick) + 4.0, tick);
  }
  const double band = frame.y(std::numeric_limits<double>::infinity());
  svg +=
      fmt::format(R"(<rect class="band" x="{0}" y="{1}" width="{2}" height="{3}"/>)"
                  R"(<text class="tick" x="{4}" y="{5:.1f}" text-anchor="end">exact</text>)",
                  kLeft, kBandTop, right - kLeft, kTop - kBandTop - 8.0, kLeft - 6.0, band + 4.0);
  svg += fmt::format(
      R"(<text class="axis" x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)"
      R"svg(<text class="axis" x="14" y="{:.1f}" text-anchor="middle" transform="rotate(-90 14 {:.1f})">)svg"
      R"(PSNR over lit pixels, dB</text>)",
      0.5 * (kLeft + right), kHeight - 10.0, escaped(plot.price_axis), 0.5 * (kTop + bottom),
      0.5 * (kTop + bottom));
  return svg;
}

/// A regular polygon about a point, first corner at the angle given; a star if every other corner
/// is pulled in to a part of the radius.
std::string polygon(double x, double y, int corners, double radius, double angle_rad,
                    double inner = 1.0) {
  std::string points;
  for (int i = 0; i < corners; ++i) {
    const double a = angle_rad + 2.0 * std::numbers::pi * i / corners;
    const double r = i % 2 == 0 ? radius : inner * radius;
    points += fmt::format("{:.1f},{:.1f} ", x + r * std::cos(a), y + r * std::sin(a));
  }
  return fmt::format(R"(<polygon points="{}")", points);
}

std::string mark(double x, double y, int style, bool full, const std::string& title) {
  const auto kind = static_cast<std::size_t>(style) % kColors.size();
  std::string shape;
  switch (kind) {
    case 0: shape = polygon(x, y, 4, 7.0, 0.0); break;
    case 1: shape = fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="5")", x, y); break;
    case 2: shape = polygon(x, y, 4, 6.5, std::numbers::pi / 4.0); break;
    case 3: shape = polygon(x, y, 3, 7.0, -std::numbers::pi / 2.0); break;
    case 4: shape = polygon(x, y, 3, 7.0, std::numbers::pi / 2.0); break;
    case 5: shape = polygon(x, y, 5, 6.5, -std::numbers::pi / 2.0); break;
    default: shape = polygon(x, y, 8, 8.0, 0.0, 0.4); break;  // a star of four rays
  }
  const char* color = kColors[kind];
  return fmt::format(R"({} fill="{}" stroke="{}" stroke-width="1.8"><title>{}</title></{}>)", shape,
                     full ? color : "#ffffff", color, escaped(title),
                     kind == 1 ? "circle" : "polygon");
}

std::string drawn(const PlotSeries& series, const std::vector<bool>& front, const Frame& frame) {
  std::string path;
  std::string marks;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const PlotPoint& point = series.points[i];
    const double x = frame.x(point.price);
    const double y = frame.y(point.quality);
    path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x, y);
    marks += mark(x, y, series.style, front[i], point.title);
    const bool room = x < 0.8 * kWidth;  // else the word goes to the mark's left
    marks += fmt::format(R"(<text class="name" x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)",
                         room ? x + 8.0 : x - 9.0, y - 5.0, room ? "start" : "end",
                         escaped(point.label));
  }
  const auto kind = static_cast<std::size_t>(series.style) % kColors.size();
  return fmt::format(
      R"(<path d="{}" fill="none" stroke="{}" stroke-width="1.2" opacity="0.55"/>{})", path,
      kColors[kind], marks);
}

bool beats(const PlotPoint& a, const PlotPoint& b) {
  return a.price <= b.price && a.quality >= b.quality &&
         (a.price < b.price || a.quality > b.quality);
}

}  // namespace

std::vector<std::vector<bool>> on_front(const std::vector<PlotSeries>& series) {
  std::vector<std::vector<bool>> front;
  for (const PlotSeries& own : series) {
    front.emplace_back();
    for (const PlotPoint& point : own.points) {
      const bool beaten = std::ranges::any_of(series, [&](const PlotSeries& other) {
        return std::ranges::any_of(other.points,
                                   [&](const PlotPoint& rival) { return beats(rival, point); });
      });
      front.back().push_back(!beaten);
    }
  }
  return front;
}

std::string to_svg(const ScatterPlot& plot) {
  const bool any = std::ranges::any_of(
      plot.series, [](const PlotSeries& series) { return !series.points.empty(); });
  if (!any) return "";
  const Frame frame = frame_of(plot);
  const auto front = on_front(plot.series);
  std::string svg = fmt::format(
      R"(<svg viewBox="0 0 {:g} {:g}" role="img" aria-label="{}"><text class="title" x="{:g}" y="20">{}</text>)",
      kWidth, kHeight, escaped(plot.title), kLeft, escaped(plot.title));
  svg += axes(plot, frame);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    svg += drawn(plot.series[i], front[i], frame);
  }
  return svg + "</svg>\n";
}

std::string legend_mark(int style) {
  return fmt::format(R"(<svg class="mark" viewBox="0 0 18 18">{}</svg>)",
                     mark(9.0, 9.0, style, true, ""));
}

}  // namespace nacre
