#pragma once

#include <string>
#include <vector>

namespace tanglebin {

/// A mean and the spread around it; without a spread, low and high equal the mean.
struct PlotPoint {
  double x = 0;
  double y = 0;
  double low = 0;
  double high = 0;
};

/// Points that share a name and colour.
struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;  ///< ascending by x
  bool is_published = false;      ///< numbers from the paper: open diamonds without a line
};

/// A line plot.
struct Plot {
  std::string text;  ///< description for readers who cannot see the plot
  std::string x_label;
  std::string y_label;
  double y_greatest = 1;  ///< upper end of the axis; the lower end is below the data
  std::vector<PlotSeries> series;
};

/// The plot as an <svg> element, as wide as its container, and the list of its series. It needs no script: a
/// browser shows a mark's numbers under the pointer. Its colours are suitable for colour-blind readers (Okabe
/// and Ito 2008) and for light and dark pages. Throws std::invalid_argument for a plot without points.
std::string html(const Plot& plot);

/// The style sheet that html() relies on.
extern const char* const plot_style;

}  // namespace tanglebin
