#pragma once

#include <string>
#include <vector>

namespace nacre {

/// A method in a plot of error against a price.
struct PlotPoint {
  double price = 0.0;    ///< positive: seconds, bytes
  double quality = 0.0;  ///< dB; infinite for the truth itself
  std::string label;     ///< beside the mark: "24"
  std::string title;     ///< shown under the pointer
};

/// Points that share a colour and a mark, joined in their order.
struct PlotSeries {
  std::string name;
  int style = 0;  ///< colour and mark, from 0
  std::vector<PlotPoint> points;
};

struct ScatterPlot {
  std::string title;
  std::string price_axis;   ///< "milliseconds a frame"
  double price_unit = 1.0;  ///< the axis shows price / unit
  std::vector<PlotSeries> series;
};

/// For each point, series by series, whether no other has as good a quality at no higher price, and
/// is better in one of the two: the Pareto front.
std::vector<std::vector<bool>> on_front(const std::vector<PlotSeries>& series);

/// The plot as an SVG element for a page: the price on a logarithmic axis, PSNR upwards, and above
/// it a band for what has no error. Marks on the Pareto front are full, others hollow. Needs
/// nothing from elsewhere; empty if there is no point.
std::string to_svg(const ScatterPlot& plot);

/// The mark of a style alone, for a legend.
std::string legend_mark(int style);

}  // namespace nacre
