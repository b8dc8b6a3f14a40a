#include "tanglebin/report/plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <stdexcept>

namespace tanglebin {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Plot two_lines() {
  return {.text = "Two lines.",
          .x_label = "x",
          .y_label = "y",
          .series = {{.name = "first", .points = {{1, 0.9, 0.8, 0.95}, {2, 0.7, 0.6, 0.8}}},
                     {.name = "second", .points = {{1, 0.8, 0.7, 0.9}, {2, 0.6, 0.5, 0.7}}},
                     {.name = "printed", .points = {{1, 0.85, 0.85, 0.85}}, .is_published = true}}};
}

int count(const std::string& text, const std::string& part) {
  int result = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++result;
  return result;
}

TEST(Plot, IsAnElementThatIsAsWideAsItsPage) {
  const std::string text = html(two_lines());
  EXPECT_THAT(text, StartsWith("<svg class=\"plot\" viewBox=\"0 0 "));
  const std::string element = text.substr(0, text.find('>'));
  EXPECT_THAT(element, Not(HasSubstr(" width=")));
  EXPECT_THAT(element, HasSubstr(R"(role="img" aria-label="Two lines.")"));
}

TEST(Plot, HasAMarkForEachPointAndALineForEachSeriesThatWasMeasured) {
  const std::string text = html(two_lines());
  const std::string picture = text.substr(0, text.find("<ul"));
  EXPECT_EQ(count(picture, "class=\"mark\""), 5);
  EXPECT_EQ(count(picture, "<polyline"), 2);
  EXPECT_EQ(count(text.substr(picture.size()), "<li>"), 3);
}

// The vertical axis goes from 0.5, at 222 pixels, to 1, at 10; the horizontal from 0, at 54, to 3, at 408.
TEST(Plot, PointsAreWhereTheirNumbersAre) {
  Plot plot = two_lines();
  plot.series.erase(plot.series.begin() + 1);
  EXPECT_THAT(html(plot), HasSubstr("<polyline points=\"172.0,52.4 290.0,137.2 \""));
}

TEST(Plot, TellsTheNumbersOfAMarkUnderThePointer) {
  const std::string text = html(two_lines());
  EXPECT_THAT(text, HasSubstr("<title>first, 1: 0.900 (0.800 to 0.950)</title>"));
  EXPECT_THAT(text, HasSubstr("<title>printed, 1: 0.850</title>"));
}

TEST(Plot, TheSamePlotGivesTheSameBytes) {
  EXPECT_EQ(html(two_lines()), html(two_lines()));
}

TEST(Plot, NamesAreTextHoweverTheyLook) {
  Plot plot = two_lines();
  plot.series[0].name = "<b>\"'&";
  plot.x_label = plot.y_label = plot.text = "\"><script>";
  const std::string text = html(plot);
  EXPECT_THAT(text, HasSubstr("&lt;b&gt;&quot;&#39;&amp;"));
  EXPECT_THAT(text, Not(HasSubstr("<script>")));
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(("<div>" + text + "</div>").c_str()), tinyxml2::XML_SUCCESS)
      << document.ErrorStr();
}

TEST(Plot, ManyValuesHaveRoundLabels) {
  Plot plot{.text = "", .x_label = "", .y_label = "", .series = {{"one", {}}}};
  for (int i = 1; i <= 20; ++i) plot.series[0].points.push_back({1.0 * i, 0.9, 0.9, 0.9});
  const std::string text = html(plot);
  EXPECT_THAT(text, HasSubstr(">20</text>"));
  EXPECT_THAT(text, HasSubstr(">10</text>"));
  EXPECT_THAT(text, Not(HasSubstr(">7</text>")));
}

TEST(Plot, OneSinglePointIsAPlot) {
  const Plot plot{.text = "", .x_label = "", .y_label = "", .series = {{"one", {{7, 1, 1, 1}}}}};
  EXPECT_THAT(html(plot), HasSubstr(">7</text>"));
}

TEST(Plot, WithoutPointsIsAMistake) {
  Plot plot = two_lines();
  for (PlotSeries& series : plot.series) series.points.clear();
  EXPECT_THROW(html(plot), std::invalid_argument);
}

}  // namespace
}  // namespace tanglebin
