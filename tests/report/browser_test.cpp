// The page as a browser shows it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "tanglebin/report/page.hpp"
#include "tests/report/synthetic_results.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Each;
using testing::Ge;
using testing::Gt;
using testing::SizeIs;

constexpr int phone_width = 375;

// Measures the page that it is appended to, and tells the page around it.
constexpr const char* measure = R"html(<script>
addEventListener("load", () => {
  const all = (selector, value, root = document) => [...root.querySelectorAll(selector)].map(value);
  const isInside = (element, frame) => {
    const a = element.getBoundingClientRect(), b = frame.getBoundingClientRect();
    return a.width > 0 && a.left >= b.left - 1 && a.right <= b.right + 1 && a.top >= b.top - 1 && a.bottom <= b.bottom + 1;
  };
  const plot = svg => ({
    width: svg.getBoundingClientRect().width,
    lines: all("g[id*=_plot_] path, g[id*=_plot_] use", mark => mark.getBBox().width + mark.getBBox().height, svg),
    cutMarks: all("text, g[id*=_plot_] use", mark => isInside(mark, svg) ? 0 : 1, svg).reduce((a, b) => a + b, 0),
    textHeights: all("text", text => text.getBoundingClientRect().height, svg),
  });
  const ids = all("[id]", element => element.id);
  parent.postMessage(JSON.stringify({
    windowWidth: innerWidth,
    pageWidth: document.documentElement.scrollWidth,
    imageWidths: all("img", image => image.complete ? image.naturalWidth : 0),
    shownWidths: all("img", image => image.getBoundingClientRect().width),
    plots: all("svg.plot", plot),
    idsGivenTwice: ids.length - new Set(ids).size,
    headings: all("h1, h2, h3", heading => Number(heading.tagName[1])),
    images: all("img, svg", element => (element.alt || element.ariaLabel || "").length),
  }), "*");
});
</script>)html";

constexpr const char* frame = R"html(<!DOCTYPE html>
<iframe src="page.html" width="375" height="800" style="border: 0"></iframe>
<script>
addEventListener("message", event => { document.body.textContent = "MEASURED" + event.data + "END"; });
</script>)html";

/// What the page measures in a window as wide as a phone's. (A browser's own window cannot be so small.)
json measured_on_a_phone(const std::string& page) {
  const test::TemporaryDirectory directory;
  test::write_bytes(directory / "page.html", page + measure);
  test::write_bytes(directory / "frame.html", frame);
  const std::string command =
      "timeout 240 chromium --headless --no-sandbox --hide-scrollbars --disable-gpu --disable-dev-shm-usage "
      "--user-data-dir=" +
      (directory / "profile").string() + " --virtual-time-budget=20000 --dump-dom file://" +
      (directory / "frame.html").string() + " >" + (directory / "dom").string() + " 2>" +
      (directory / "err").string();
  const int status = std::system(command.c_str());
  const std::string dom = test::bytes_of(directory / "dom");
  const std::size_t begin = dom.find("MEASURED{");
  const std::size_t end = dom.find("}END");
  if (begin == std::string::npos || end == std::string::npos) {
    ADD_FAILURE() << "chromium, status " << status << ", gave\n" << dom << test::bytes_of(directory / "err");
    return {};
  }
  return json::parse(dom.substr(begin + 8, end + 1 - begin - 8));
}

std::string synthetic_page(const test::SyntheticResults& settings) {
  const test::TemporaryDirectory directory;
  test::write_synthetic_results(directory.path(), settings);
  return report_page(read_results_directory(directory.path()));
}

void expect_a_sound_page(const json& page, std::size_t pictures, std::size_t series) {
  ASSERT_TRUE(page.is_object());
  EXPECT_EQ(page["windowWidth"], phone_width);
  EXPECT_EQ(page["pageWidth"], phone_width) << "the page scrolls sideways";
  EXPECT_THAT(page["imageWidths"].get<std::vector<double>>(), AllOf(SizeIs(pictures), Each(Gt(0))));
  EXPECT_THAT(page["shownWidths"].get<std::vector<double>>(), Each(Gt(100)));
  EXPECT_THAT(page["plots"], SizeIs(2));
  for (const json& plot : page["plots"]) {
    EXPECT_GT(plot["width"], 300);
    EXPECT_THAT(plot["lines"].get<std::vector<double>>(), AllOf(SizeIs(Ge(series)), Each(Gt(0))));
    EXPECT_EQ(plot["cutMarks"], 0);
    EXPECT_THAT(plot["textHeights"].get<std::vector<double>>(), AllOf(SizeIs(Gt(5U)), Each(Gt(9))));
  }
  EXPECT_EQ(page["idsGivenTwice"], 0);
  EXPECT_THAT(page["images"].get<std::vector<int>>(), Each(Gt(10))) << "an image without a text";
  std::vector<int> headings = page["headings"].get<std::vector<int>>();
  EXPECT_EQ(headings.front(), 1);
  headings.erase(headings.begin());
  EXPECT_THAT(headings, AllOf(SizeIs(7), Each(2)));
}

class Browser : public testing::Test {
protected:
  void SetUp() override {
    if (std::system("command -v chromium >/dev/null") != 0) GTEST_SKIP() << "chromium is not installed";
  }
};

TEST_F(Browser, ShowsThePapersExperimentOnAPhone) {
  expect_a_sound_page(measured_on_a_phone(synthetic_page({})), 6, 2);
}

TEST_F(Browser, ShowsSeveralMethodsAndSetsOnAPhone) {
  const std::string page = synthetic_page(
      {.sets = {"A", "B", "a-set-of-a-long-name_and-longer"}, .cases = 2, .methods = {"paper", "axis"}});
  expect_a_sound_page(measured_on_a_phone(page), 12, 6);
}

TEST_F(Browser, ShowsASingleRun) {
  const std::string page = synthetic_page({.sets = {"C"}, .tubes = {4}, .cases = 1, .ratios = {0.5}});
  expect_a_sound_page(measured_on_a_phone(page), 6, 1);
}

// The measurements above would tell.
TEST_F(Browser, ABrokenPictureAndAnEmptyPlotAreSeen) {
  std::string page = synthetic_page({.sets = {"A"}, .tubes = {2, 3}, .cases = 1});
  const std::string png = "data:image/png;base64,iVBOR";
  ASSERT_NE(page.find(png), std::string::npos);
  page.replace(page.find(png), png.size(), "data:image/png;base64,AAAAA");
  const std::string symbol = "id='plot_8-gpPt6'";
  ASSERT_NE(page.find(symbol), std::string::npos);
  page.replace(page.find(symbol), symbol.size(), "id='gone'");
  const json measured = measured_on_a_phone(page);
  ASSERT_TRUE(measured.is_object());
  EXPECT_EQ(measured["imageWidths"][0], 0);
  EXPECT_THAT(measured["plots"][0]["lines"].get<std::vector<double>>(), testing::Contains(0));
}

}  // namespace
}  // namespace tanglebin
