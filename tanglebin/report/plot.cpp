#include "tanglebin/report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <regex>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "tanglebin/base/error.hpp"
#include "tanglebin/report/html.hpp"
#include "tanglebin/report/process.hpp"

namespace tanglebin {
namespace {

constexpr int width = 420;

/// The number of columns of the key above the plot: two if the names are short enough.
int key_columns(const Plot& plot) {
  constexpr std::size_t longest = 18;
  const auto is_short = [](const PlotSeries& series) { return series.name.size() <= longest; };
  return std::ranges::all_of(plot.series, is_short) ? 2 : 1;
}

int height(const Plot& plot) {
  constexpr int without_key = 270;
  constexpr int key_line = 18;
  const int columns = key_columns(plot);
  return without_key + key_line * ((static_cast<int>(plot.series.size()) + columns - 1) / columns);
}

/// The look of a series' points. Each differs from all others in colour, shape and dashes. The colours have a
/// contrast of at least 3 with both white and the dark page.
struct Look {
  const char* color;
  int point;
  int dashes;
};
constexpr std::array<Look, 6> looks = {{{"#0072B2", 7, 1},
                                        {"#D55E00", 5, 2},
                                        {"#009E73", 9, 4},
                                        {"#B0629A", 11, 5},
                                        {"#7A7A7A", 13, 3},
                                        {"#9C7A00", 7, 2}}};
constexpr int open_diamond = 12;

// ---- What the plot spans
// -------------------------------------------------------------------------------

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

/// A multiple of 0.1 below all the data.
double y_least(const Plot& plot) {
  double least = plot.y_greatest;
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& point : series.points) least = std::min(least, point.low);
  return (std::ceil(least * 10 - 1e-9) - 1) / 10;
}

/// The distance between the labels of the vertical axis.
double y_step(double range) {
  if (range < 0.35) return 0.05;
  return range < 0.65 ? 0.1 : 0.2;
}

/// A label at each x if they do not overlap; otherwise gnuplot's choice of round numbers.
std::string tics(const std::vector<double>& x) {
  constexpr std::size_t most = 12;
  if (x.size() > most) return "autofreq";
  std::string text;
  for (const double value : x) text += fmt::format("{}{:.12g}", text.empty() ? "(" : ", ", value);
  return text + ")";
}

// ---- The script
// -------------------------------------------------------------------------------------------

/// A gnuplot string. Between single quotes only the quote itself is special; it becomes a typographic quote,
/// because doubling it, as in gnuplot's manual, ends the string if it comes first.
std::string quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += "’";
    } else {
      result += std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c;
    }
  }
  return result + "'";
}

/// A name that fits into the key, because gnuplot omits longer ones. Cuts out the middle: names that begin
/// alike may end in different methods.
std::string shortened(const std::string& name) {
  constexpr std::size_t longest = 36;
  constexpr std::size_t tail = 11;
  if (name.size() <= longest) return name;
  const auto is_inside_character = [&](std::size_t i) {
    return (static_cast<unsigned char>(name[i]) & 0xC0U) == 0x80;  // UTF-8
  };
  std::size_t end_of_head = longest - tail - 1;
  while (is_inside_character(end_of_head)) --end_of_head;
  std::size_t begin_of_tail = name.size() - tail;
  while (is_inside_character(begin_of_tail)) ++begin_of_tail;
  return name.substr(0, end_of_head) + "…" + name.substr(begin_of_tail);
}

/// Horizontal offsets of the series, so that no bar hides another; 0 for the paper's numbers.
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

std::string data_block(std::size_t index, const std::vector<PlotPoint>& points, double shift) {
  std::string text = fmt::format("$series{} << END\n", index);
  for (const PlotPoint& point : points) {
    text += fmt::format("{} {} {} {}\n", point.x + shift, point.y, point.low, point.high);
  }
  return text + "END\n";
}

std::string curves(std::size_t index, const PlotSeries& series) {
  const Look& look = looks[index % looks.size()];
  if (series.is_published) {
    return fmt::format(
        "$series{} using 1:2 with points pointtype {} pointsize 1.3 linewidth 2 linecolor rgb 'black' "
        "title {}",
        index, open_diamond, quoted(shortened(series.name)));
  }
  return fmt::format(
      "$series{0} using 1:3:(0):($4-$3) with vectors nohead linewidth 5 linecolor rgb '#A0{1}' notitle, "
      "$series{0} using 1:2 with linespoints pointtype {2} pointsize 0.6 linewidth 1.6 dashtype {3} "
      "linecolor rgb '{4}' title {5}",
      index, std::string_view(look.color).substr(1), look.point, look.dashes, look.color,
      quoted(shortened(series.name)));
}

std::string script(const Plot& plot) {
  const std::vector<double> x = all_x(plot);
  const double gap = least_gap(x);
  std::string text = fmt::format(
      "set encoding utf8\n"
      "set terminal svg size {},{} dynamic noenhanced font 'sans-serif,13' name {}\n"
      "set border 3 linewidth 1\n"
      "set tics nomirror out scale 0.6\n"
      "set grid ytics linewidth 0.5 linetype 1 linecolor rgb '#A0A0A0'\n"
      "set key outside top center horizontal maxcols {} samplen 1.5 width -3\n"
      "set xlabel {}\nset ylabel {}\n"
      "set xtics {}\nset mxtics 5\n"
      "set ytics {}\n"
      "set xrange [{}:{}]\nset yrange [{}:{}]\n",
      width, height(plot), quoted(plot.id), key_columns(plot), quoted(plot.x_label), quoted(plot.y_label),
      tics(x), y_step(plot.y_greatest - y_least(plot)), x.front() - gap, x.back() + gap, y_least(plot),
      plot.y_greatest);
  const std::vector<double> shift = shifts(plot.series, gap);
  std::string commands;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    text += data_block(i, plot.series[i].points, shift[i]);
    commands += (i == 0 ? "plot " : ", ") + curves(i, plot.series[i]);
  }
  return text + commands + "\n";
}

// ---- The picture
// ------------------------------------------------------------------------------------------

std::string draw(const std::string& commands) {
  ProcessResult gnuplot;
  try {
    // Ignores gnuplot settings of the machine and the user.
    gnuplot = run_process({"gnuplot", "--default-settings"}, commands);
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::no_such_file_or_directory) throw;
    throw SystemError("the plots need gnuplot, which is not installed (Debian: apt install gnuplot-nox)");
  }
  if (gnuplot.status != 0 || !gnuplot.out.ends_with("</svg>\n\n")) {
    throw std::runtime_error(fmt::format("gnuplot failed with status {}: {}", gnuplot.status, gnuplot.err));
  }
  return gnuplot.out;
}

/// Makes ids unique to this picture, because gnuplot uses the same ones in each. Removes the title of each
/// group, which is only its id but would be shown by browsers. (Ids occur only inside tags: text has no '<'.)
std::string with_own_ids(const std::string& picture, const std::string& id) {
  static const std::regex definition(R"re((<[^<>]*\bid=['"])(?!\w+_plot_))re");
  static const std::regex use(R"re((<[^<>]*\bhref='#))re");
  static const std::regex title(R"re(<title>[^<]*</title>)re");
  std::string result = std::regex_replace(picture, title, "");
  result = std::regex_replace(result, definition, "$1" + id + "-");
  return std::regex_replace(result, use, "$1" + id + "-");
}

/// The picture as an element of a page. Replaces gnuplot's header, which contains gnuplot's version.
std::string as_element(const std::string& picture, const Plot& plot) {
  const std::size_t content = picture.find("<g id=\"gnuplot_canvas\">");
  if (content == std::string::npos)
    throw std::runtime_error("gnuplot wrote an unexpected SVG (not like version 5.4)");
  return fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {} {}\" xmlns=\"http://www.w3.org/2000/svg\" "
      "xmlns:xlink=\"http://www.w3.org/1999/xlink\" role=\"img\" aria-label=\"{}\">\n{}",
      width, height(plot), escaped(plot.text), with_own_ids(picture.substr(content), plot.id));
}

}  // namespace

const char* const plot_style = R"css(
.plot { display: block; width: 100%; max-width: 34rem; height: auto; }
.plot text, .plot tspan { font-family: inherit; }
.plot [fill="black"] { fill: currentColor; }
.plot [stroke="black"] { stroke: currentColor; }
.plot [color="black"] { color: inherit; }
)css";

std::string svg(const Plot& plot) {
  const auto is_empty = [](const PlotSeries& series) { return series.points.empty(); };
  if (std::ranges::all_of(plot.series, is_empty)) throw std::invalid_argument("a plot without points");
  return as_element(draw(script(plot)), plot);
}

}  // namespace tanglebin
