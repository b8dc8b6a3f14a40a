#include "tanglebin/report/scene_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/report/viewed_scene.hpp"
#include "tests/support/browser.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using nlohmann::json;
using test::strip_length;
using test::strip_width;
using test::two_tubes;
using testing::AllOf;
using testing::ElementsAre;
using testing::Gt;
using testing::HasSubstr;
using testing::Not;

template <typename Value>
std::vector<Value> decoded(const json& base64) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : base64.get<std::string>()) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(alphabet.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xFFU);
  }
  std::vector<Value> values(bytes.size() / sizeof(Value));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Value));
  return values;
}

TEST(SceneView, PointsAreWhereTheyAreWithinAStep) {
  const ViewedScene scene = two_tubes();
  const json points = json::parse(scene_json(scene)).at("points");
  const auto coordinates = decoded<std::uint16_t>(points.at("coordinates"));
  ASSERT_EQ(coordinates.size(), 3 * scene.cloud.points.size());
  const double step = points.at("step");
  EXPECT_LT(step, 0.3 / 60000);
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const double shown = points.at("origin")[i % 3].get<double>() + step * coordinates[i];
    ASSERT_NEAR(shown, scene.cloud.points[i / 3][static_cast<Eigen::Index>(i % 3)], step);
  }
}

TEST(SceneView, FoundLabelsAreShownAsThoseOfTheTrueTubes) {
  const ViewedScene scene = two_tubes();
  const json found = json::parse(scene_json(scene)).at("labellings").at(1);
  const auto labels = decoded<std::int16_t>(found.at("labels"));
  ASSERT_EQ(labels.size(), scene.cloud.points.size());
  EXPECT_EQ(std::ranges::count(labels, 7), 0);
  EXPECT_EQ(std::ranges::count(labels, 1), strip_length * strip_width * 3 / 2);
  EXPECT_EQ(std::ranges::count(labels, -1), strip_length * strip_width / 2);
  EXPECT_EQ(found.at("tubes")[0].at("label"), 1);
  const json& score = found.at("score");
  EXPECT_EQ(score.at("micro_recall"), 0.5);
  EXPECT_EQ(score.at("tubes")[0].at("correct"), strip_length * strip_width);
  EXPECT_EQ(score.at("tubes")[1].at("correct"), 0);
  EXPECT_EQ(score.at("tubes")[1].at("unlabelled"), strip_length * strip_width / 2);
}

TEST(SceneView, OfManyPointsARandomPartIsShownAlwaysTheSame) {
  const ViewedScene scene = two_tubes();
  const json points = json::parse(scene_json(scene, 900)).at("points");
  EXPECT_EQ(points.at("count"), 900);
  EXPECT_EQ(points.at("of"), scene.cloud.points.size());
  EXPECT_EQ(decoded<std::uint16_t>(points.at("coordinates")).size(), 2700U);
  EXPECT_EQ(scene_json(scene, 900), scene_json(scene, 900));
}

TEST(SceneView, PointsThatAreNowhereAreLeftOut) {
  ViewedScene scene = two_tubes();
  scene.cloud.points[3].x() = std::numeric_limits<float>::quiet_NaN();
  const json shown = json::parse(scene_json(scene));
  EXPECT_EQ(shown.at("points").at("of"), scene.cloud.points.size() - 1);
  EXPECT_EQ(decoded<std::int16_t>(shown.at("labellings")[0].at("labels")).size(),
            scene.cloud.points.size() - 1);
}

TEST(SceneView, RefusesWhatItCannotShow) {
  ViewedScene scene = two_tubes();
  scene.truth->labels.front() = 40'000;
  EXPECT_THAT(test::complaint([&] { scene_json(scene); }), HasSubstr("two tubes: label: found"));
  ViewedScene nothing;
  nothing.name = "nothing";
  EXPECT_THAT(test::complaint([&] { scene_json(nothing); }),
              HasSubstr("nothing: found a scene without points and tubes"));
}

TEST(SceneView, NamesAreText) {
  ViewedScene scene = two_tubes();
  scene.name = "</script><script>alert(1)</script>";
  scene.found.front().name = scene.name;
  EXPECT_THAT(view_page(scene), Not(HasSubstr("<script>alert(1)")));
}

// ---- In a browser
// -------------------------------------------------------------------------------------------

// Works the page as a reader does.
constexpr const char* look_around = R"js(
// The page draws a scene once the reader sees it.
addEventListener("load", () => setTimeout(() => {
  const canvas = document.querySelector(".scene-view canvas");
  const [, colours] = document.querySelectorAll(".scene-choices select");
  const [trueLines, foundLines] = document.querySelectorAll(".scene-choices input");
  const change = (control, property, value) => {
    control[property] = value;
    control.dispatchEvent(new Event("change"));
  };
  const { pixels, count } = paintedOn(canvas);
  const press = key => {
    canvas.dispatchEvent(new KeyboardEvent("keydown", { key, cancelable: true }));
    return pixels().reduce((sum, value, i) => (31 * sum + value * (i % 8191)) % 1000003, 7);
  };
  const scene = JSON.parse(SCENE);
  const told = { size: [canvas.width, canvas.height], pageWidth: document.documentElement.scrollWidth };
  change(trueLines, "checked", false);
  change(foundLines, "checked", false);
  change(colours, "value", "truth");
  told.truth = scene.palette.slice(0, 3).map(count);
  change(colours, "value", "error");
  told.error = ["#0072b2", "#d55e00", "#e8b400"].map(count);
  told.legend = [...document.querySelectorAll(".scene-legend li")].map(entry => entry.textContent);
  told.linesOff = count("#e6007a");
  change(foundLines, "checked", true);
  told.linesOn = count("#e6007a");
  change(foundLines, "checked", false);
  const [first, second] = document.querySelectorAll(".scene-tubes button");
  first.click();
  told.onlyFirst = ["#0072b2", "#d55e00"].map(count);
  told.pressed = [first, second].map(button => button.getAttribute("aria-pressed"));
  first.click();
  told.rows = [...document.querySelectorAll(".scene-tubes tbody tr")].map(row => row.innerText.trim().split(/\s+/));
  const views = [press("Home"), press("ArrowLeft"), press("ArrowUp"), press("+"), press("Home")];
  told.turned = new Set(views).size;
  told.isBack = views[0] === views[4];
  const { left, top, width, height } = canvas.getBoundingClientRect();
  canvas.dispatchEvent(new PointerEvent("pointermove", { clientX: left + width / 2, clientY: top + height / 2 }));
  told.hover = document.querySelector(".scene-hover").value;
  parent.postMessage(JSON.stringify(told), "*");
}, 500));
)js";

json seen(const ViewedScene& scene, int window_width) {
  std::string script = std::string(test::painted_on) + look_around;
  const std::string name = "SCENE";
  script.replace(script.find(name), name.size(), json(scene_json(scene)).dump());
  return test::told_by_page(view_page(scene), script, window_width);
}

class SceneInBrowser : public testing::TestWithParam<int> {
protected:
  void SetUp() override {
    if (!test::has_browser()) GTEST_SKIP() << "chromium is not installed";
  }
};

TEST_P(SceneInBrowser, IsColouredTurnedAndToldAboutAsAReaderChooses) {
  const json told = seen(two_tubes(), GetParam());
  ASSERT_TRUE(told.is_object());
  EXPECT_LE(told["pageWidth"], GetParam()) << "the page scrolls sideways";
  const auto counts = [&](const char* name) { return told[name].get<std::vector<int>>(); };
  EXPECT_THAT(counts("truth"), ElementsAre(Gt(1000), Gt(1000), Gt(1000)));
  EXPECT_THAT(counts("error"), ElementsAre(Gt(1000), Gt(500), Gt(500)));
  EXPECT_THAT(
      told["legend"].get<std::vector<std::string>>(),
      ElementsAre("right", "given to another tube or the bin", "no label", "not scored: no tube in truth"));
  EXPECT_EQ(told["linesOff"], 0);
  EXPECT_GT(told["linesOn"], 100);
  EXPECT_THAT(counts("onlyFirst"), ElementsAre(Gt(1000), 0)) << "tube 1 is right everywhere";
  EXPECT_THAT(told["pressed"].get<std::vector<std::string>>(), ElementsAre("true", "false"));
  EXPECT_THAT(told["rows"][0].get<std::vector<std::string>>(),
              ElementsAre("1", "12,000", "100.0", "%", "0.0", "%", "0.0", "%", "0.667"));
  EXPECT_THAT(told["rows"][1].get<std::vector<std::string>>(),
              ElementsAre("2", "12,000", "0.0", "%", "50.0", "%", "50.0", "%", "0.000"));
  EXPECT_EQ(told["turned"], 4) << "each key changes the picture";
  EXPECT_TRUE(told["isBack"]);
  EXPECT_THAT(told["hover"].get<std::string>(), AllOf(HasSubstr("mm"), HasSubstr("truth: ")));
}

INSTANTIATE_TEST_SUITE_P(Widths, SceneInBrowser, testing::Values(1280, 390));

}  // namespace
}  // namespace tanglebin
