#pragma once

#include <string>
#include <vector>

namespace tanglebin {

/// A mean with the spread around it; low and high are the mean where there is none.
struct PlotPoint {
  double x = 0;
  double y = 0;
  double low = 0;
  double high = 0;
};

/// Points with one name and colour.
struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;  ///< ascending by x
  bool is_published = false;      ///< numbers of the paper: open diamonds without a line
};

/// A line plot.
struct Plot {
  std::string id;    ///< a letter, then letters, digits and '_'; another for each plot of a page
  std::string text;  ///< what it shows, for those who cannot see it
  std::string x_label;
  std::string y_label;
  double y_greatest = 1;  ///< the axis ends here, and begins below the least of the data
  std::vector<PlotSeries> series;
};

/// The plot as an <svg> element for an HTML page: as wide as what it stands in, in colours that colour-blind
/// eyes tell apart (Okabe and Ito 2008), on light and dark pages (black is the page's currentColor by
/// plot_style). Drawn by gnuplot; the same plot gives the same bytes. Throws std::invalid_argument for a plot
/// without points, std::runtime_error where gnuplot is not installed or fails.
std::string svg(const Plot& plot);

/// The style sheet that svg() relies on.
extern const char* const plot_style;

}  // namespace tanglebin
