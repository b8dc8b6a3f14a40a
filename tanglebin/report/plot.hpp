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
  std::string id;    ///< a letter, then letters, digits and '_'; unique on the page
  std::string text;  ///< description for readers who cannot see the plot
  std::string x_label;
  std::string y_label;
  double y_greatest = 1;  ///< upper end of the axis; the lower end is below the data
  std::vector<PlotSeries> series;
};

/// The plot as an <svg> element for an HTML page, as wide as its container. Its colours are suitable for
/// colour-blind readers (Okabe and Ito 2008) and for light and dark pages (black becomes the page's
/// currentColor through plot_style). Drawn by gnuplot; the same plot gives the same bytes. Throws
/// std::invalid_argument for a plot without points, std::runtime_error if gnuplot is not installed or fails.
std::string svg(const Plot& plot);

/// The style sheet that svg() relies on.
extern const char* const plot_style;

}  // namespace tanglebin
