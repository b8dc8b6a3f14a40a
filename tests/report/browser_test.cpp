// The page as a browser shows it.
#include "tests/support/browser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tanglebin/report/page.hpp"
#include "tests/report/synthetic_results.hpp"
#include "tests/report/viewed_scene.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::Ge;
using testing::Gt;
using testing::SizeIs;
using testing::StartsWith;

constexpr int phone_width = 375;

// Measures the page that it is appended to.
constexpr const char* measure = R"js(
addEventListener("load", () => {
  const all = (selector, value, root = document) => [...root.querySelectorAll(selector)].map(value);
  const isInside = (element, frame) => {
    const a = element.getBoundingClientRect(), b = frame.getBoundingClientRect();
    return a.width > 0 && a.left >= b.left - 1 && a.right <= b.right + 1 && a.top >= b.top - 1 && a.bottom <= b.bottom + 1;
  };
  const plot = svg => ({
    width: svg.getBoundingClientRect().width,
    lines: [...svg.querySelectorAll(".series polyline, .series .mark")]
      .filter(mark => mark.points?.numberOfItems !== 1)
      .map(mark => mark.getBBox().width + mark.getBBox().height),
    cutMarks: all("text, .mark", mark => isInside(mark, svg) ? 0 : 1, svg).reduce((a, b) => a + b, 0),
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
    images: all("img, svg.plot, canvas", element => (element.alt || element.getAttribute("aria-label") || "").length),
  }), "*");
});
)js";

json measured_on_a_phone(const std::string& page) {
  return test::told_by_page(page, measure, phone_width);
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
  EXPECT_THAT(headings, AllOf(SizeIs(10), Each(2)));
}

class Browser : public testing::Test {
protected:
  void SetUp() override {
    if (!test::has_browser()) GTEST_SKIP() << "chromium is not installed";
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

// ---- All runs
// ---------------------------------------------------------------------------------------------------

// Sorts, filters, turns pages and plots as a reader does.
constexpr const char* try_runs = R"js(
addEventListener("load", () => {
  const root = document.querySelector(".runs");
  const rows = () => [...root.querySelectorAll("tbody tr")].map(row => [...row.cells].map(cell => cell.textContent));
  const heading = text => [...root.querySelectorAll("thead button")].find(button => button.textContent === text);
  const column = text => [...root.querySelectorAll("thead tr > *")].findIndex(cell => cell.textContent === text);
  const sorted = () => root.querySelector("[aria-sort]").getAttribute("aria-sort");
  const choose = (i, value) => {
    const select = root.querySelectorAll("select")[i];
    select.value = value;
    select.dispatchEvent(new Event("change"));
  };
  const inked = canvas => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data
    .reduce((count, value, i) => count + (i % 4 === 3 && value > 0 ? 1 : 0), 0);
  const labels = () => [...root.querySelectorAll("canvas")].map(canvas => canvas.getAttribute("aria-label"));
  const told = { pageWidth: document.documentElement.scrollWidth };
  told.worst = rows().map(row => Number(row[column("micro-recall")]));
  heading("seconds").click();
  told.fastest = rows().map(row => Number(row[column("seconds")]));
  told.focused = document.activeElement.textContent;
  heading("seconds").click();
  told.slowest = rows().map(row => Number(row[column("seconds")]));
  told.sorted = sorted();
  told.place = root.querySelector("output").value;
  choose(3, "axis");
  choose(5, "0.3");
  root.querySelectorAll(".runs-pages button")[1].click();
  told.filtered = [...new Set(rows().map(row => row[column("method")] + row[column("ratio")]))];
  told.filteredPlace = root.querySelector("output").value;
  choose(0, "mean_iou");
  choose(1, "seconds");
  told.labels = labels();
  told.inked = [...root.querySelectorAll("canvas")].map(inked);
  parent.postMessage(JSON.stringify(told), "*");
});
)js";

TEST_F(Browser, SortsFiltersAndPlotsAllRuns) {
  const std::string page =
      synthetic_page({.tubes = {1, 5, 10}, .cases = 10, .methods = {"paper", "axis"}, .ratios = {0.3, 1}});
  for (const int width : {1280, 390}) {
    const json told = test::told_by_page(page, try_runs, width);
    ASSERT_TRUE(told.is_object());
    EXPECT_LE(told["pageWidth"], width) << "the page scrolls sideways";
    const auto numbers = [&](const char* name) { return told[name].get<std::vector<double>>(); };
    EXPECT_THAT(numbers("worst"), SizeIs(20));
    EXPECT_TRUE(std::ranges::is_sorted(numbers("worst")));
    EXPECT_TRUE(std::ranges::is_sorted(numbers("fastest")));
    EXPECT_TRUE(std::ranges::is_sorted(numbers("slowest"), std::greater<>()));
    EXPECT_LT(numbers("fastest").back(), numbers("slowest").back());
    EXPECT_EQ(told["focused"], "seconds") << "the keyboard stays where it was";
    EXPECT_EQ(told["sorted"], "descending");
    EXPECT_EQ(told["place"], "runs 1 to 20 of 240");
    EXPECT_THAT(told["filtered"].get<std::vector<std::string>>(), ElementsAre("axis0.3"));
    EXPECT_EQ(told["filteredPlace"], "runs 21 to 40 of 60");
    EXPECT_THAT(told["labels"].get<std::vector<std::string>>(),
                ElementsAre(StartsWith("mean IoU of 60 runs against seconds."),
                            StartsWith("Histogram of mean IoU of 60 runs.")));
    EXPECT_THAT(told["inked"].get<std::vector<int>>(), Each(Gt(1000)));
  }
}

// Plots against a scanner, whose names stand side by side, and against a number that is drawn.
constexpr const char* try_scanners = R"js(
addEventListener("load", () => {
  const root = document.querySelector(".runs");
  const choose = (i, value) => {
    const select = root.querySelectorAll("select")[i];
    select.value = value;
    select.dispatchEvent(new Event("change"));
  };
  const chart = Chart.getChart(root.querySelector("canvas"));
  const places = () => [...new Set(chart.data.datasets.flatMap(({ data }) => data.map(({ x }) => x)))].sort();
  const told = { headings: [...root.querySelectorAll("thead button")].map(button => button.textContent) };
  choose(1, "scanner");
  told.scanners = places();
  told.ticks = chart.scales.x.ticks.map(tick => tick.label);
  told.mean = chart.data.datasets[0].data[1].text;
  choose(1, "bin.friction");
  told.frictions = places();
  choose(3, "right");
  told.rows = root.querySelector("output").value;
  parent.postMessage(JSON.stringify(told), "*");
});
)js";

TEST_F(Browser, PlotsAgainstScannersAndDrawnNumbers) {
  const std::string page = synthetic_page(
      {.sets = {"A"}, .tubes = {5}, .cases = 10, .scanners = {"right", "left"}, .ratios = {0.3}});
  const json told = test::told_by_page(page, try_scanners, 1280);
  ASSERT_TRUE(told.is_object());
  EXPECT_THAT(told["headings"].get<std::vector<std::string>>(),
              testing::IsSupersetOf({"scanner", "bin.friction"}));
  EXPECT_THAT(told["scanners"].get<std::vector<double>>(), ElementsAre(0, 1));
  EXPECT_THAT(told["ticks"].get<std::vector<std::string>>(), ElementsAre("left", "right"));
  EXPECT_THAT(told["mean"].get<std::string>(),
              testing::ContainsRegex("^paper, scanner right: mean 0.* of 10 runs$"));
  EXPECT_THAT(told["frictions"].get<std::vector<double>>(), ElementsAre(0.5, 0.625, 0.75, 0.875));
  EXPECT_EQ(told["rows"], "runs 1 to 10 of 10");
}

// ---- A scene in 3D, from its run
// -------------------------------------------------------------------------------------------

// Opens the scene of a row of each method, then turns and zooms it with the mouse and with two fingers.
constexpr const char* try_scene = R"js(
addEventListener("load", () => {
  const canvas = document.querySelector(".scene-view canvas");
  const { pixels, count } = paintedOn(canvas);
  const rows = () => [...document.querySelectorAll(".runs tbody tr")];
  const buttons = () => rows().map(row => row.querySelector("button")).filter(button => button);
  const told = { rows: rows().length, names: buttons().map(button => button.getAttribute("aria-label")) };
  const open = method => {
    const row = rows().find(row => row.querySelector("button") && [...row.cells].some(cell => cell.textContent === method));
    row.querySelector("button").click();
    return {
      errors: ["#0072b2", "#d55e00", "#e8b400"].map(count),
      caption: document.querySelector(".scene-tubes caption").textContent,
      isFocused: document.activeElement === canvas,
      top: Math.abs(document.querySelector(".scene-view").getBoundingClientRect().top),
    };
  };
  told.paper = open("paper");
  told.axis = open("axis");
  const picture = () => pixels().reduce((sum, value, i) => (31 * sum + value * (i % 8191)) % 1000003, 7);
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const at = (x, y) => ({ clientX: left + x * width, clientY: top + y * height, bubbles: true, cancelable: true });
  const touches = (...places) => {
    const list = places.map(([x, y], identifier) => {
      const { clientX, clientY } = at(x, y);
      return new Touch({ identifier, target: canvas, clientX, clientY, pageX: clientX + scrollX, pageY: clientY + scrollY });
    });
    return { touches: list, targetTouches: list, changedTouches: list, bubbles: true, cancelable: true };
  };
  const pinch = () => {
    canvas.dispatchEvent(new TouchEvent("touchstart", touches([0.4, 0.5], [0.6, 0.5])));
    canvas.dispatchEvent(new TouchEvent("touchmove", touches([0.2, 0.5], [0.8, 0.5])));
    canvas.dispatchEvent(new TouchEvent("touchend", touches()));
  };
  const drag = () => {
    canvas.dispatchEvent(new MouseEvent("mousedown", at(0.4, 0.5)));
    canvas.dispatchEvent(new MouseEvent("mousemove", at(0.6, 0.5)));
    canvas.dispatchEvent(new MouseEvent("mouseup", at(0.6, 0.5)));
  };
  const finger = () => {
    canvas.dispatchEvent(new TouchEvent("touchstart", touches([0.4, 0.5])));
    canvas.dispatchEvent(new TouchEvent("touchmove", touches([0.4, 0.7])));
    canvas.dispatchEvent(new TouchEvent("touchend", touches()));
  };
  const wheel = () => canvas.dispatchEvent(new WheelEvent("wheel", { ...at(0.5, 0.5), deltaY: 300 }));
  told.pictures = [() => {}, drag, wheel, finger, pinch].map(act => (act(), picture()));
  parent.postMessage(JSON.stringify(told), "*");
});
)js";

// Results of which one scene is there in 3D: the paper's method has half of it wrong, the other none.
std::string page_with_a_scene() {
  const test::TemporaryDirectory directory;
  test::write_synthetic_results(
      directory.path(),
      {.sets = {"A"}, .tubes = {2}, .cases = 3, .methods = {"paper", "axis"}, .ratios = {0.3}});
  ViewedScene scene = test::two_tubes();
  scene.name = "A2/1, ratio 0.3 (lowest of paper)";
  scene.found.front().name = "paper";
  scene.found.push_back({"axis", scene.truth->labels, scene.truth->tubes});
  test::write_bytes(directory / "scenes.jsonl", scene_json(scene) + "\n");
  return report_page(read_results_directory(directory.path()));
}

TEST_F(Browser, OpensASceneFromItsRunWithTheLabelsOfItsMethod) {
  for (const int width : {1280, 390}) {
    const json told =
        test::told_by_page(page_with_a_scene(), std::string(test::painted_on) + try_scene, width);
    ASSERT_TRUE(told.is_object());
    EXPECT_EQ(told["rows"], 6);
    EXPECT_THAT(told["names"].get<std::vector<std::string>>(),
                ElementsAre("Show A2/1 in 3D", "Show A2/1 in 3D"));
    EXPECT_THAT(told["paper"]["errors"].get<std::vector<int>>(), ElementsAre(Gt(1000), Gt(500), Gt(500)));
    EXPECT_THAT(told["axis"]["errors"].get<std::vector<int>>(), ElementsAre(Gt(2000), 0, 0));
    EXPECT_THAT(told["paper"]["caption"].get<std::string>(),
                StartsWith("What each tube lost with paper: micro-recall 0.5"));
    EXPECT_THAT(told["axis"]["caption"].get<std::string>(),
                StartsWith("What each tube lost with axis: micro-recall 1.0"));
    EXPECT_TRUE(told["axis"]["isFocused"]);
    EXPECT_LT(told["axis"]["top"], 2) << "the scene is scrolled to";
    std::vector<int> pictures = told["pictures"].get<std::vector<int>>();
    std::ranges::sort(pictures);
    EXPECT_EQ(std::ranges::adjacent_find(pictures), pictures.end()) << "each act changes the picture";
  }
}

// The measurements above would tell.
TEST_F(Browser, ABrokenPictureAndAnEmptyPlotAreSeen) {
  std::string page = synthetic_page({.sets = {"A"}, .tubes = {2, 3}, .cases = 1});
  const std::string png = "data:image/png;base64,iVBOR";
  ASSERT_NE(page.find(png), std::string::npos);
  page.replace(page.find(png), png.size(), "data:image/png;base64,AAAAA");
  const std::string line = "<polyline points";
  ASSERT_NE(page.find(line), std::string::npos);
  page.replace(page.find(line), line.size(), "<polyline gone");
  const json measured = measured_on_a_phone(page);
  ASSERT_TRUE(measured.is_object());
  EXPECT_EQ(measured["imageWidths"][0], 0);
  EXPECT_THAT(measured["plots"][0]["lines"].get<std::vector<double>>(), testing::Contains(0));
}

}  // namespace
}  // namespace tanglebin
