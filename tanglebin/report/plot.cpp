#include "tanglebin/report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

#include "tanglebin/report/html.hpp"

namespace tanglebin {
namespace {

// ---- Looks
// --------------------------------------------------------------------------------------------------

/// The look of a series. Each differs from all others in colour, mark and dashes. The colours have a contrast
/// of at least 3 with both white and the dark page.
struct Look {
  const char* color;
  const char* mark;  ///< outline around (0, 0)
  const char* dashes;
};
constexpr const char* disc = "M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0z";
constexpr std::array<Look, 6> looks = {{{"#0072B2", disc, "none"},
                                        {"#D55E00", "M-3.5,-3.5h7v7h-7z", "7 3"},
                                        {"#009E73", "M0,-4.5L4.2,3.2H-4.2z", "2 2"},
                                        {"#B0629A", "M0,4.5L4.2,-3.2H-4.2z", "7 2 2 2"},
                                        {"#7A7A7A", "M0,-4.8L4.8,0L0,4.8L-4.8,0z", "4 2"},
                                        {"#9C7A00", disc, "7 3"}}};
constexpr const char* diamond = "M0,-6L6,0L0,6L-6,0z";

const Look& look_of(std::size_t series) {
  return looks[series % looks.size()];
}

std::string mark(const PlotSeries& series, const Look& look) {
  if (series.is_published) {
    return fmt::format(R"(<path class="mark" d="{}" fill="none" stroke="currentColor" stroke-width="1.6"/>)",
                       diamond);
  }
  return fmt::format(R"(<path class="mark" d="{}" fill="{}"/>)", look.mark, look.color);
}

// ---- Axes
// ---------------------------------------------------------------------------------------------------

constexpr double width = 420;
constexpr double height = 270;
constexpr double left = 54;
constexpr double right = 408;
constexpr double top = 10;
constexpr double bottom = 222;

/// What part of an axis is shown, and where it has labels.
struct Axis {
  double least;
  double greatest;
  std::vector<double> ticks;

  double share(double value) const { return (value - least) / (greatest - least); }
};

std::vector<double> all_x(const Plot& plot) {
  std::set<double> values;
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& point : series.points) values.insert(point.x);
  return {values.begin(), values.end()};
}

/// The smallest gap between neighbouring values; 1 for a single value.
double least_gap(const std::vector<double>& x) {
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < x.size(); ++i) gap = std::min(gap, x[i] - x[i - 1]);
  return std::isfinite(gap) ? gap : 1;
}

/// The multiples of a step from `least` to `greatest`.
std::vector<double> multiples(double step, double least, double greatest) {
  constexpr double slack = 1e-9;
  const auto first = static_cast<int>(std::ceil(least / step - slack));
  const auto last = static_cast<int>(std::floor(greatest / step + slack));
  std::vector<double> values;
  for (int i = first; i <= last; ++i) values.push_back(i * step);
  return values;
}

/// A label at each value if they do not overlap; otherwise at a few round ones.
std::vector<double> x_ticks(const std::vector<double>& x) {
  constexpr std::size_t most = 12;
  if (x.size() <= most) return x;
  const double range = x.back() - x.front();
  const double magnitude = std::pow(10, std::floor(std::log10(range)));
  for (const double step : {0.1, 0.2, 0.5, 1.0}) {
    std::vector<double> ticks = multiples(step * magnitude, x.front(), x.back());
    if (ticks.size() <= most) return ticks;
  }
  return {x.front(), x.back()};
}

Axis x_axis(const std::vector<double>& x) {
  const double gap = least_gap(x);
  return {.least = x.front() - gap, .greatest = x.back() + gap, .ticks = x_ticks(x)};
}

double y_step(double range) {
  if (range < 0.35) return 0.05;
  return range < 0.65 ? 0.1 : 0.2;
}

/// From a multiple of 0.1 below all the data.
Axis y_axis(const Plot& plot) {
  double least = plot.y_greatest;
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& point : series.points) least = std::min(least, point.low);
  least = (std::ceil(least * 10 - 1e-9) - 1) / 10;
  return {.least = least,
          .greatest = plot.y_greatest,
          .ticks = multiples(y_step(plot.y_greatest - least), least, plot.y_greatest)};
}

/// Where numbers are in the picture, pixels.
struct Frame {
  Axis x;
  Axis y;

  double across(double value) const { return std::lerp(left, right, x.share(value)); }
  double down(double value) const { return std::lerp(bottom, top, y.share(value)); }
};

std::string line(double x1, double y1, double x2, double y2, const std::string& attributes) {
  return fmt::format(R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" {}/>)", x1, y1, x2, y2,
                     attributes);
}

std::string text(double x, double y, const std::string& anchor, const std::string& words) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", x, y, anchor,
                     escaped(words));
}

std::string axes(const Plot& plot, const Frame& frame) {
  const std::string grid = R"(class="grid")";
  const std::string solid = R"(stroke="currentColor")";
  std::string svg;
  for (const double tick : frame.y.ticks) {
    const double y = frame.down(tick);
    svg += line(left, y, right, y, grid) + text(left - 8, y + 4.5, "end", fmt::format("{:.6g}", tick));
  }
  for (const double tick : frame.x.ticks) {
    const double x = frame.across(tick);
    svg +=
        line(x, bottom, x, bottom + 5, solid) + text(x, bottom + 19, "middle", fmt::format("{:.6g}", tick));
  }
  svg += line(left, bottom, right, bottom, solid) + line(left, top, left, bottom, solid);
  svg += text(std::midpoint(left, right), height - 8, "middle", plot.x_label);
  const double middle = std::midpoint(top, bottom);
  return svg +
         fmt::format(R"svg(<text text-anchor="middle" transform="translate(13 {}) rotate(-90)">{}</text>)svg",
                     middle, escaped(plot.y_label)) +
         "\n";
}

// ---- Series
// -------------------------------------------------------------------------------------------------

/// How far the series are moved to the side, so that no bar hides another; 0 for the paper's numbers.
std::vector<double> shifts(const std::vector<PlotSeries>& series, double gap) {
  const auto count = static_cast<double>(std::ranges::count(series, false, &PlotSeries::is_published));
  const double step = gap * std::min(0.2, 0.6 / count);
  std::vector<double> result;
  double next = -step * (count - 1) / 2;
  for (const PlotSeries& one : series) {
    result.push_back(one.is_published ? 0 : next);
    if (!one.is_published) next += step;
  }
  return result;
}

/// What a browser shows of a mark under the pointer.
std::string words_of(const PlotPoint& point, const std::string& name) {
  const std::string spread =
      point.low < point.high ? fmt::format(" ({:.3f} to {:.3f})", point.low, point.high) : "";
  return fmt::format("{}, {:.6g}: {:.3f}{}", name, point.x, point.y, spread);
}

std::string drawn(const PlotSeries& series, const Look& look, double shift, const Frame& frame) {
  std::string bars;
  std::string marks;
  std::string path;
  for (const PlotPoint& point : series.points) {
    const double x = frame.across(point.x + shift);
    const double y = frame.down(point.y);
    bars += line(x, frame.down(point.low), x, frame.down(point.high), R"(class="spread")");
    path += fmt::format("{:.1f},{:.1f} ", x, y);
    marks += fmt::format(R"svg(<g transform="translate({:.1f} {:.1f})"><title>{}</title>{}</g>)svg", x, y,
                         escaped(words_of(point, series.name)), mark(series, look));
  }
  if (series.is_published) return fmt::format("<g class=\"series\">{}</g>\n", marks);
  return fmt::format(
      "<g class=\"series\" stroke=\"{0}\">{1}<polyline points=\"{2}\" stroke-dasharray=\"{3}\"/></g>\n"
      "<g class=\"series\">{4}</g>\n",
      look.color, bars, path, look.dashes, marks);
}

std::string key(const std::vector<PlotSeries>& series) {
  std::string items;
  for (std::size_t i = 0; i < series.size(); ++i) {
    items += fmt::format("<li><svg viewBox=\"-7 -7 14 14\" aria-hidden=\"true\">{}</svg>{}</li>\n",
                         mark(series[i], look_of(i)), escaped(series[i].name));
  }
  return "<ul class=\"plot-key\">\n" + items + "</ul>\n";
}

}  // namespace

const char* const plot_style = R"css(
.plot { display: block; width: 100%; max-width: 34rem; height: auto; }
.plot text { font-family: inherit; font-size: 13px; fill: currentColor; }
.plot .grid { stroke: var(--line); }
.plot .spread { stroke-width: 5; stroke-opacity: 0.38; }
.plot polyline { fill: none; stroke-width: 1.6; }
.plot-key { display: flex; flex-wrap: wrap; gap: 0.1rem 1.2rem; margin: 0.2rem 0 0; padding: 0; list-style: none; font-size: 0.85rem; max-width: 34rem; }
.plot-key svg { width: 0.9em; height: 0.9em; margin-right: 0.4em; vertical-align: -0.1em; }
)css";

std::string html(const Plot& plot) {
  const std::vector<double> x = all_x(plot);
  if (x.empty()) throw std::invalid_argument("a plot without points");
  const Frame frame{.x = x_axis(x), .y = y_axis(plot)};
  const std::vector<double> shift = shifts(plot.series, least_gap(x));
  std::string series;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    series += drawn(plot.series[i], look_of(i), shift[i], frame);
  }
  return fmt::format(
             "<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n{}{}</svg>\n", width,
             height, escaped(plot.text), axes(plot, frame), series) +
         key(plot.series);
}

}  // namespace tanglebin
