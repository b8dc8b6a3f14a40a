#include "tanglebin/report/plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::ThrowsMessage;

Plot two_lines() {
  return {.id = "plot",
          .text = "Two lines.",
          .x_label = "x",
          .y_label = "y",
          .series = {{.name = "first", .points = {{1, 0.9, 0.8, 0.95}, {2, 0.7, 0.6, 0.8}}},
                     {.name = "second", .points = {{1, 0.8, 0.7, 0.9}, {2, 0.6, 0.5, 0.7}}},
                     {.name = "printed", .points = {{1, 0.85, 0.85, 0.85}}, .is_published = true}}};
}

/// Goes to a directory, and back at the end of the scope.
class WorkingDirectory {
public:
  explicit WorkingDirectory(const std::filesystem::path& directory)
      : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(directory);
  }
  ~WorkingDirectory() { std::filesystem::current_path(before_); }
  WorkingDirectory(const WorkingDirectory&) = delete;
  WorkingDirectory& operator=(const WorkingDirectory&) = delete;

private:
  std::filesystem::path before_;
};

TEST(Plot, IsAnElementThatIsAsWideAsItsPage) {
  const std::string text = svg(two_lines());
  EXPECT_THAT(text, StartsWith("<svg class=\"plot\" viewBox=\"0 0 "));
  const std::string element = text.substr(0, text.find('>'));
  EXPECT_THAT(element, Not(HasSubstr(" width=")));
  EXPECT_THAT(element, HasSubstr(R"(role="img" aria-label="Two lines.")"));
  for (const char* name : {"first", "second", "printed"}) EXPECT_THAT(text, HasSubstr(name));
}

TEST(Plot, TheSamePlotGivesTheSameBytes) {
  EXPECT_EQ(svg(two_lines()), svg(two_lines()));
}

TEST(Plot, TheUsersGnuplotSettingsStayOutOfIt) {
  const test::TemporaryDirectory home;
  test::write_bytes(home / ".gnuplot", "set title 'from the home directory'\n");
  const std::string before = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
  setenv("HOME", home.path().c_str(), 1);
  const std::string text = svg(two_lines());
  setenv("HOME", before.c_str(), 1);
  EXPECT_THAT(text, Not(HasSubstr("from the home directory")));
}

TEST(Plot, IdsOfTwoPlotsOnAPageDoNotClash) {
  Plot other = two_lines();
  other.id = "other";
  const std::string a = svg(two_lines());
  const std::string b = svg(other);
  for (std::size_t at = a.find(" id="); at != std::string::npos; at = a.find(" id=", at + 1)) {
    const std::string id = a.substr(at, a.find_first_of("'\"", at + 5) - at);
    EXPECT_THAT(b, Not(HasSubstr(id))) << id;
  }
  // Symbols are found under their new ids.
  EXPECT_THAT(b, HasSubstr("id='other-gpPt6'"));
  EXPECT_THAT(b, HasSubstr("href='#other-gpPt6'"));
}

TEST(Plot, NamesAreTextHoweverTheyLook) {
  const test::TemporaryDirectory directory;
  const WorkingDirectory there(directory.path());
  Plot plot = two_lines();
  plot.series[0].name = "'; system('touch made'); '";
  plot.series[1].name = "`touch made`\n@x {/B <b>} id=\"x\" ö";
  plot.text = "\"><script>";
  const std::string text = svg(plot);
  EXPECT_FALSE(std::filesystem::exists(directory / "made"));
  EXPECT_THAT(text, HasSubstr("’; system(’touch made’); ’"));
  EXPECT_THAT(text, HasSubstr("`touch made` @x {/B &lt;b>} id=\"x\" ö"));
  EXPECT_THAT(text, Not(HasSubstr("<script>")));
}

TEST(Plot, ALongNameLosesItsMiddle) {
  Plot plot = two_lines();
  plot.series[0].name = "Set " + std::string(64, 'a') + ", paper";
  plot.series[1].name = "Set " + std::string(9, 'a') + "öööööööööööööööööööööööö, paper";
  const std::string text = svg(plot);
  EXPECT_THAT(text, HasSubstr("Set aaaaaaaaaaaaaaaaaaaa…aaaa, paper<"));
  EXPECT_THAT(text, HasSubstr("Set aaaaaaaaaööööö…öö, paper<"));
}

TEST(Plot, OneSinglePointIsAPlot) {
  const Plot plot{
      .id = "plot", .text = "", .x_label = "", .y_label = "", .series = {{"one", {{7, 1, 1, 1}}}}};
  EXPECT_THAT(svg(plot), HasSubstr("xlink:href='#plot-gpPt6'"));
}

TEST(Plot, WithoutPointsIsAMistake) {
  Plot plot = two_lines();
  for (PlotSeries& series : plot.series) series.points.clear();
  EXPECT_THROW(svg(plot), std::invalid_argument);
}

TEST(Plot, WithoutGnuplotItIsSaidWhatToInstall) {
  const test::TemporaryDirectory empty;
  const std::string path = std::getenv("PATH");
  setenv("PATH", empty.path().c_str(), 1);
  EXPECT_THAT([] { svg(two_lines()); }, ThrowsMessage<SystemError>(HasSubstr("gnuplot-nox")));
  setenv("PATH", path.c_str(), 1);
}

TEST(Plot, WhatGnuplotComplainsOfIsPassedOn) {
  Plot plot = two_lines();
  plot.id = "no-id";
  EXPECT_THAT([&] { svg(plot); }, ThrowsMessage<std::runtime_error>(HasSubstr("must contain only")));
}

}  // namespace
}  // namespace tanglebin
