#include "tanglebin/recipe/randomization.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "tests/recipe/recipes.hpp"
#include "tests/support/recipe_of_0_1_0.hpp"
#include "tests/support/statistics.hpp"

namespace tanglebin {
namespace {

using ::testing::HasSubstr;

const std::string sets =
    "[[set]]\nname = \"A\"\ntubes = [1, 3]\n[set.tube]\nradius = { min = 0.008, max = 0.0125 }\nmass = 0.5\n"
    "length = 0.5\nbend_max_deg = 30\ncylinders_max = { min = 6, max = 8 }\n"
    "[[set]]\nname = \"B\"\ntubes = [2]\n[set.tube]\nradius = 0.0125\nmass = { one_of = [0.4, 0.5] }\n"
    "length = 0.5\nbend_max_deg = 45\n";

const std::string scanner =
    "[scanner]\npreset = \"zivid-one-plus-l\"\nbaseline = { min = 0.1, max = 0.3 }\n"
    "hfov_deg = { min = 30, max = 60 }\n"
    "position = [{ min = -0.2, max = 0.2 }, 0, { one_of = [1.5, 2] }]\nlook_at = [0, 0, 0.1]\n";

std::map<std::string, double> drawn(const Recipe& recipe, const CaseId& id) {
  std::map<std::string, double> numbers;
  for (const DrawnNumber& number : draw(recipe, id)) numbers[number.path] = number.value;
  return numbers;
}

TEST(Randomization, NumbersAreDrawnForEachCaseFromItsNameAlone) {
  const Recipe recipe = read("seed = 3\n" + scanner + sets);
  const auto first = drawn(recipe, {"A", 3, 1});
  EXPECT_EQ(drawn(recipe, {"A", 3, 1}), first);
  EXPECT_EQ(first.size(), 6U) << "without those of set B's tubes";
  EXPECT_TRUE(first.contains("set[0].tube.radius"));
  EXPECT_TRUE(drawn(recipe, {"B", 2, 1}).contains("set[1].tube.mass"));
  EXPECT_NE(drawn(recipe, {"A", 3, 2}).at("scanner.baseline"), first.at("scanner.baseline"));
  EXPECT_NE(drawn(recipe, {"A", 1, 1}).at("scanner.baseline"), first.at("scanner.baseline"));
  EXPECT_NE(drawn(read("seed = 4\n" + scanner + sets), {"A", 3, 1}).at("scanner.baseline"),
            first.at("scanner.baseline"));
}

TEST(Randomization, ASetsNumbersDoNotDependOnTheSetsBefore) {
  const std::string only_b = sets.substr(sets.rfind("[[set]]"));
  const Recipe both = read(scanner + sets);
  const Recipe alone = read(scanner + only_b);
  for (int number = 1; number <= 20; ++number) {
    const CaseId id{"B", 2, number};
    EXPECT_EQ(drawn(alone, id).at("set[0].tube.mass"), drawn(both, id).at("set[1].tube.mass"));
    EXPECT_EQ(drawn(alone, id).at("scanner.baseline"), drawn(both, id).at("scanner.baseline"));
  }
}

TEST(Randomization, EachKindOfTubesHasNumbersOfItsOwn) {
  const std::string kind =
      "[[set.tube]]\nradius = { min = 0.008, max = 0.0125 }\nmass = 0.5\nlength = 0.5\nbend_max_deg = 30\n";
  const Recipe recipe = read("[[set]]\nname = \"M\"\ntubes = [2]\n" + kind + kind);
  const CaseId id{"M", 2, 1};
  const auto numbers = drawn(recipe, id);
  const Recipe resolved = resolve(recipe, draw(recipe, id));
  ASSERT_EQ(resolved.sets[0].kinds.size(), 2U);
  EXPECT_EQ(resolved.sets[0].kinds[0].radius, numbers.at("set[0].tube[0].radius"));
  EXPECT_EQ(resolved.sets[0].kinds[1].radius, numbers.at("set[0].tube[1].radius"));
  EXPECT_NE(resolved.sets[0].kinds[0].radius, resolved.sets[0].kinds[1].radius);
  EXPECT_EQ(write(read(write(recipe))), write(recipe));
}

TEST(Randomization, AScannersNumbersGoWithItsName) {
  const std::string left = "[[scanner]]\nname = \"left\"\nsigma = { min = 0, max = 0.001 }\n";
  const std::string right = "[[scanner]]\nname = \"right\"\nsigma = { min = 0, max = 0.001 }\n";
  const CaseId id{"A", 1, 1};
  const auto left_first = drawn(read(left + right + sets), id);
  const auto right_first = drawn(read(right + left + sets), id);
  EXPECT_EQ(left_first.at("scanner[0].sigma"), right_first.at("scanner[1].sigma"));
  EXPECT_EQ(left_first.at("scanner[1].sigma"), right_first.at("scanner[0].sigma"));
  EXPECT_NE(left_first.at("scanner[0].sigma"), left_first.at("scanner[1].sigma"));
}

TEST(Randomization, ThePrincipalPointIsDrawnInAnImageOfFixedSize) {
  const Recipe recipe = read(
      "[scanner]\npreset = \"zivid-one-plus-l\"\nwidth = 960\nheight = 600\n"
      "cx = { min = 470, max = 490 }\n" +
      sets);
  const CaseId id{"A", 1, 1};
  const Camera camera = resolve(recipe, draw(recipe, id)).camera;
  EXPECT_EQ(camera.cx, drawn(recipe, id).at("scanner.cx"));
  EXPECT_EQ(camera.cy, 299.5);
  EXPECT_EQ(camera.fx, 1365);
  EXPECT_EQ(write(read(write(recipe))), write(recipe));
}

TEST(Randomization, LimitsOfAnySizeComeBack) {
  for (int exponent = -20; exponent <= 20; ++exponent) {
    const Recipe recipe = read(
        fmt::format("[scanner]\nfx = {{ min = 1e{}, max = 2e{} }}\nfy = 1\n", exponent, exponent) + sets);
    const Recipe again = read(write(recipe));
    const CaseId id{"A", 1, 1};
    EXPECT_EQ(drawn(again, id), drawn(recipe, id));
    EXPECT_EQ(resolve(again, draw(again, id)).camera.fx, drawn(recipe, id).at("scanner.fx"));
  }
}

TEST(Randomization, ACasesRecipeHasTheDrawnNumbersAndNothingRandom) {
  const Recipe recipe = read(scanner + sets);
  for (int number = 1; number <= 20; ++number) {
    const std::vector<DrawnNumber> numbers = draw(recipe, {"A", 3, number});
    const auto by_path = drawn(recipe, {"A", 3, number});
    const Recipe resolved = resolve(recipe, numbers);
    EXPECT_TRUE(resolved.random.empty());
    EXPECT_EQ(resolved.sensor.baseline, by_path.at("scanner.baseline"));
    EXPECT_EQ(resolved.camera.pose.translation().x(), by_path.at("scanner.position[0]"));
    EXPECT_EQ(resolved.camera.pose.translation().z(), by_path.at("scanner.position[2]"));
    EXPECT_EQ(resolved.sets[0].kinds[0].radius, by_path.at("set[0].tube.radius"));
    EXPECT_EQ(resolved.sets[0].kinds[0].segments[0].cylinders_max, by_path.at("set[0].tube.cylinders_max"));
    EXPECT_NEAR(std::atan(960 / resolved.camera.fx) * 360 / 3.14159265358979, by_path.at("scanner.hfov_deg"),
                1e-9);
    EXPECT_NEAR((*project(resolved.camera, {0, 0, 0.1}) - Eigen::Vector2d(959.5, 599.5)).norm(), 0, 1e-9)
        << "looks where it is to look, wherever it stands";
    EXPECT_EQ(resolved.sensor.disparity_sigma, 0.04) << "what is not drawn is the preset's";
  }
}

TEST(Randomization, RangesAreUniformAndListsFair) {
  const Recipe recipe = read(scanner + sets);
  std::vector<double> baselines;
  std::vector<std::size_t> cylinders(3);
  std::vector<std::size_t> heights(2);
  for (int number = 1; number <= 600; ++number) {
    const auto numbers = drawn(recipe, {"A", 1, number});
    baselines.push_back(numbers.at("scanner.baseline"));
    ++cylinders.at(static_cast<std::size_t>(numbers.at("set[0].tube.cylinders_max")) - 6);
    ++heights.at(numbers.at("scanner.position[2]") == 2 ? 1 : 0);
  }
  EXPECT_GT(test::uniform_p(baselines, 0.1, 0.3), test::significance);
  EXPECT_GT(test::equal_counts_p(cylinders), test::significance);
  EXPECT_GT(test::equal_counts_p(heights), test::significance);
}

TEST(Randomization, TheResolvedRecipeKeepsWhatIsDrawn) {
  for (const std::string& text :
       {scanner + sets,
        "[bin]\nheight = { min = 0.2, max = 0.3 }\n[settle]\nfriction = { one_of = [1] }\n" + sets,
        "[scanner]\nwidth = { one_of = [960, 1920] }\nfocal_length_px = 2000\n" + sets,
        "[scanner]\nsigma = { min = 0, max = 0.001 }\nfootprint = 2\n" + sets}) {
    const Recipe recipe = read(text);
    const Recipe again = read(write(recipe));
    EXPECT_TRUE(again == recipe);
    EXPECT_EQ(difference(again, recipe), std::nullopt);
    for (const CaseId& id : {CaseId{"A", 3, 1}, CaseId{"A", 3, 2}, CaseId{"B", 2, 7}}) {
      EXPECT_EQ(drawn(again, id), drawn(recipe, id));
      EXPECT_EQ(resolve(again, draw(again, id)), resolve(recipe, draw(recipe, id)));
    }
  }
}

TEST(Randomization, WhatIsDrawnIsTheSameInAnyVersion) {
  const Recipe recipe = read(test::source_of_0_1_0);
  EXPECT_EQ(draw(recipe, {"A", 2, 1}), test::drawn_by_0_1_0);
  EXPECT_EQ(draw(read(test::recipe_of_0_1_0), {"A", 2, 1}), test::drawn_by_0_1_0);
}

TEST(Randomization, ARecipeOfAnEarlierVersionIsTheSame) {
  const Recipe recipe = read(test::source_of_0_1_0);
  EXPECT_EQ(read(test::recipe_of_0_1_0), recipe);
  EXPECT_EQ(difference(read(test::recipe_of_0_1_0), recipe), std::nullopt);
}

TEST(Randomization, OnlyKindsAndSegmentsInArraysDrawToo) {
  const std::string set = "[[set]]\nname = \"A\"\ntubes = [2]\n";
  const std::string tube = "radius = { min = 0.01, max = 0.0125 }\nmass = 0.5\n";
  const std::string segment = "length = 0.5\nbend_max_deg = 30\ncylinders_max = { min = 5, max = 8 }\n";
  const Recipe plain = read(set + "[set.tube]\n" + tube + segment);
  EXPECT_EQ(read(set + "[[set.tube]]\n" + tube + segment), plain);
  const Recipe nested = read(set + "[[set.tube]]\n" + tube +
                             "[[set.tube.segment]]\nfrom = { one_of = [1] }\nto = 2\n" + segment);
  EXPECT_EQ(nested, plain);
  EXPECT_EQ(read(write(nested)), plain);
}

TEST(Randomization, AnErrorInARandomRecipeHasItsLine) {
  EXPECT_THAT(complaint("[bin]\nheight = {min = 0.2, max = 0.3}\n\nlength = -1\n" + sets),
              HasSubstr("r.toml:4: bin.length: found -1"));
  EXPECT_THAT(complaint("[scanner]\nposition = [\n  { min = 0, max = 1 },\n  0,\n  true]\n" + sets),
              HasSubstr("r.toml:5: scanner.position: found true, expected a number"));
}

TEST(Randomization, ANumberThatCannotHaveBeenDrawnIsAnError) {
  const Recipe recipe = read("[settle]\niterations = { min = 10, max = 20 }\n" + sets);
  for (const double number : {10.5, 1e300, -1e300})
    EXPECT_THAT(test::complaint([&] {
                  resolve(recipe, {{"settle.iterations", number}});
                }),
                HasSubstr("settle.iterations: found"));
  EXPECT_EQ(test::complaint([&] { resolve(recipe, {}); }), "settle.iterations: has not been drawn");
}

TEST(Randomization, ARecipeWithoutRangesDrawsNothing) {
  const Recipe recipe = read(
      "[[set]]\nname = \"A\"\ntubes = [1]\n[set.tube]\nradius = 0.0125\nmass = 0.5\n"
      "length = 0.5\nbend_max_deg = 30\n");
  EXPECT_TRUE(draw(recipe, {"A", 1, 1}).empty());
  EXPECT_EQ(write(resolve(recipe, {})), write(recipe));
}

TEST(Randomization, SaysWhichRangeIsWrongAndWhatToDo) {
  EXPECT_EQ(complaint("[bin]\n\nheight = { min = 0.3, max = 0.2 }\n" + sets),
            "r.toml:3: bin.height: found min = 0.3 and max = 0.2, expected min to be at most max");
  EXPECT_THAT(complaint("[bin]\nheight = { min = 0.3 }\n" + sets),
              HasSubstr("r.toml:2: bin.height: found a table, expected { min = NUMBER, max = NUMBER }"));
  EXPECT_THAT(complaint("[bin]\nheight.min = 0.2\nheight.max = 0.3\n" + sets),
              HasSubstr("r.toml:2: bin.height: found a table, expected a number"));
  EXPECT_THAT(complaint("[bin]\nmin = 0.2\n" + sets), HasSubstr("r.toml:2: bin: unknown key 'min'"))
      << "a table of its own is no range";
  EXPECT_THAT(complaint("[bin]\nheight = { one_of = [] }\n" + sets), HasSubstr("with at least one number"));
  EXPECT_THAT(complaint("[bin]\nheight = { one_of = [\"high\"] }\n" + sets),
              HasSubstr("bin.height: found 'high', expected finite numbers"));
  EXPECT_THAT(complaint("[settle]\niterations = { min = 10.5, max = 20 }\n" + sets),
              HasSubstr("settle.iterations: found 10.5, expected whole numbers"));
  EXPECT_THAT(complaint("seed = { min = 1, max = 2 }\n" + sets),
              HasSubstr("r.toml:1: seed: found a random number, expected a fixed one"));
  EXPECT_THAT(complaint("[scanner]\nwidth = { one_of = [960, 1920] }\n" + sets),
              HasSubstr("r.toml:2: scanner.width: found a random image size, expected hfov_deg"));
}

TEST(Randomization, BothEndsOfARangeMustMakeARecipe) {
  EXPECT_THAT(complaint("[scanner]\n\nbaseline = { min = 0, max = 0.2 }\n" + sets),
              HasSubstr("r.toml:3: scanner.baseline: found 0"));
  EXPECT_THAT(
      complaint("[bin]\n\nfriction = { min = 0.5, max = 1 }\nheight = { min = -1, max = 0.2 }\n" + sets),
      HasSubstr("r.toml:4: bin.height"));
  EXPECT_THAT(complaint("[scanner]\ndropout = { min = 0.5, max = 1 }\n" + sets),
              HasSubstr("scanner.dropout: found 1"));
}

TEST(Randomization, AllOfAListMustMakeARecipe) {
  EXPECT_THAT(complaint("[scanner]\nrotation_wxyz = [{ one_of = [-1, 0, 1] }, 0, 0, 0]\n" + sets),
              HasSubstr("found a quaternion of norm 0"));
}

}  // namespace
}  // namespace tanglebin
