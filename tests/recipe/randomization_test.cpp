#include "tanglebin/recipe/randomization.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/recipe/recipes.hpp"
#include "tests/support/recipe_of_0_1_0.hpp"
#include "tests/support/statistics.hpp"

namespace tanglebin {
namespace {

using ::testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180;

const std::string sets =
    "[[set]]\nname = \"A\"\ntubes = [1, 3]\n[set.tube]\nradius = { min = 0.008, max = 0.0125 }\nmass = 0.5\n"
    "length = 0.5\nbend_max_deg = 30\ncylinders_max = { min = 6, max = 8 }\n"
    "[[set]]\nname = \"B\"\ntubes = [2]\n[set.tube]\nradius = 0.0125\nmass = { one_of = [0.4, 0.5] }\n"
    "length = 0.5\nbend_max_deg = 45\n";

const std::string scanner =
    "[scanner]\npreset = \"zivid-one-plus-l\"\nbaseline = { min = 0.1, max = 0.3 }\n"
    "hfov_deg = { min = 30, max = 60 }\n"
    "position = [{ min = -0.2, max = 0.2 }, 0, { one_of = [1.5, 2] }]\nlook_at = [0, 0, 0.1]\n";

// A set of this kind of tubes, and of another beside it.
std::string set_of_two_kinds(const std::string& kind, const std::string& more_of_other = "") {
  return "[[set]]\nname = \"A\"\ntubes = [3, 10]\n[[set.tube]]\nlength = 0.5\nbend_max_deg = 30\n" + kind +
         "[[set.tube]]\nradius = 0.005\nmass = 0.1\nlength = 0.4\nbend_max_deg = 30\n" + more_of_other;
}

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
  const Recipe resolved = resolve(recipe, id, draw(recipe, id));
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
  const Camera camera = resolve(recipe, id, draw(recipe, id)).camera;
  EXPECT_EQ(camera.cx, drawn(recipe, id).at("scanner.cx"));
  EXPECT_EQ(camera.cy, 299.5);
  EXPECT_EQ(camera.fx, 1365);
  EXPECT_EQ(write(read(write(recipe))), write(recipe));
}

TEST(Randomization, TheScannerMovesAboutWhatItLooksAt) {
  const Recipe recipe = read(
      "[scanner]\nlook_at = [0, 0, 0.1]\ndistance = 1.5\ntilt_deg = { min = 0, max = 40 }\n"
      "azimuth_deg = { min = 0, max = 360 }\n" +
      sets);
  EXPECT_EQ(read(write(recipe)), recipe);
  for (int number = 1; number <= 20; ++number) {
    const CaseId id{"A", 1, number};
    const Camera camera = resolve(recipe, id, draw(recipe, id)).camera;
    const Eigen::Vector3d target(0, 0, 0.1);
    const Eigen::Vector3d place = camera.pose.translation() - target;
    const auto numbers = drawn(recipe, id);
    EXPECT_NEAR(place.norm(), 1.5, 1e-12);
    EXPECT_NEAR(std::acos(place.z() / 1.5) / degree, numbers.at("scanner.tilt_deg"), 1e-6);
    EXPECT_NEAR(
        std::remainder(std::atan2(place.y(), place.x()) / degree - numbers.at("scanner.azimuth_deg"), 360), 0,
        1e-6);
    EXPECT_NEAR((*project(camera, target) - Eigen::Vector2d(959.5, 599.5)).norm(), 0, 1e-9);
  }
}

// Found by fuzzing: toml++ does not convert such a number to double.
TEST(Randomization, AWholeNumberThatNoDoubleHoldsGoesWithADrawnPose) {
  const Recipe recipe = read(
      "[scanner]\nposition = [{ min = 0, max = 1 }, 0, 2]\nlook_at = [0, 9223372036854775807, 0]\n" + sets);
  EXPECT_EQ(read(write(recipe)), recipe);
}

TEST(Randomization, OnlyTheDistanceOfAScannerIsDrawn) {
  const Recipe recipe =
      read("[scanner]\nlook_at = [0, 0, 0]\ndistance = { one_of = [1, 2] }\ntilt_deg = 30\n" + sets);
  EXPECT_EQ(read(write(recipe)), recipe);
  const CaseId id{"A", 1, 1};
  EXPECT_EQ(resolve(read(write(recipe)), id, draw(recipe, id)), resolve(recipe, id, draw(recipe, id)));
}

TEST(Randomization, LimitsOfAnySizeComeBack) {
  for (int exponent = -20; exponent <= 20; ++exponent) {
    const Recipe recipe = read(
        fmt::format("[scanner]\nfx = {{ min = 1e{}, max = 2e{} }}\nfy = 1\n", exponent, exponent) + sets);
    const Recipe again = read(write(recipe));
    const CaseId id{"A", 1, 1};
    EXPECT_EQ(drawn(again, id), drawn(recipe, id));
    EXPECT_EQ(resolve(again, id, draw(again, id)).camera.fx, drawn(recipe, id).at("scanner.fx"));
  }
}

TEST(Randomization, ACasesRecipeHasTheDrawnNumbersAndNothingRandom) {
  const Recipe recipe = read(scanner + sets);
  for (int number = 1; number <= 20; ++number) {
    const std::vector<DrawnNumber> numbers = draw(recipe, {"A", 3, number});
    const auto by_path = drawn(recipe, {"A", 3, number});
    const Recipe resolved = resolve(recipe, {"A", 3, number}, numbers);
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

const std::string of_each_tube =
    "radius = { min = 0.008, max = 0.012, per = \"tube\" }\nmass = { min = 0.4, max = 0.5 }\n"
    "cylinders_max = { min = 6, max = 8, per = \"tube\" }\n";

TEST(RandomizationOfTubes, EachTubeHasNumbersOfItsOwn) {
  const Recipe recipe = read(set_of_two_kinds(of_each_tube));
  const CaseId id{"A", 10, 1};
  const SetRecipe set = resolve(recipe, id, draw(recipe, id)).sets[0];
  std::set<double> radii;
  for (int tube = 1; tube <= 9; tube += 2) {
    const TubeSpec& spec = kind_of(set, tube);
    radii.insert(spec.radius);
    EXPECT_GE(spec.radius, 0.008);
    EXPECT_LE(spec.radius, 0.012);
    EXPECT_EQ(spec.mass, kind_of(set, 1).mass) << "this number is drawn once for all";
    EXPECT_EQ(kind_of(set, tube + 1).radius, 0.005) << "tubes of the other kind";
  }
  EXPECT_EQ(radii.size(), 5U);
}

TEST(RandomizationOfTubes, ATubesNumbersDoNotDependOnTheOthers) {
  const CaseId id{"A", 10, 1};
  const auto radii = [&](const std::string& kind) {
    const Recipe recipe = read(set_of_two_kinds(kind));
    std::vector<double> all;
    for (const DrawnNumber& number : draw(recipe, id))
      if (number.path == "set[0].tube[0].radius") all.push_back(number.value);
    return all;
  };
  EXPECT_EQ(radii(of_each_tube).size(), 5U);
  EXPECT_EQ(radii(of_each_tube + "bend_min_deg = { min = 0, max = 10, per = \"tube\" }\n"),
            radii(of_each_tube));
}

TEST(RandomizationOfTubes, TheKindsOfACaseHaveTheMiddlesOfTheNumbers) {
  const Recipe recipe = read(set_of_two_kinds(of_each_tube));
  const CaseId id{"A", 3, 1};
  const TubeSpec kind = resolve(recipe, id, draw(recipe, id)).sets[0].kinds[0];
  EXPECT_EQ(kind.radius, 0.010);
  EXPECT_EQ(kind.segments[0].cylinders_max, 7);
  const Recipe others =
      read(set_of_two_kinds("radius = { one_of = [0.02, 0.008, 0.01], per = \"tube\" }\n"
                            "mass = { mean = 0.5, sigma = 0.1, min = 0.45, max = 0.9, per = \"tube\" }\n"));
  EXPECT_EQ(resolve(others, id, draw(others, id)).sets[0].kinds[0].radius, 0.01);
  EXPECT_EQ(resolve(others, id, draw(others, id)).sets[0].kinds[0].mass, 0.5);
}

TEST(RandomizationOfTubes, AreDrawnForTheSceneUnlessToldOtherwise) {
  const std::string plain = "radius = { min = 0.008, max = 0.012 }\nmass = 0.5\n";
  const std::string said = "radius = { min = 0.008, max = 0.012, per = \"scene\" }\nmass = 0.5\n";
  EXPECT_EQ(read(set_of_two_kinds(said)), read(set_of_two_kinds(plain)));
}

TEST(RandomizationOfTubes, ComeBackFromTheWrittenRecipe) {
  const Recipe recipe = read(set_of_two_kinds(of_each_tube));
  EXPECT_THAT(write(recipe), HasSubstr("radius = { min = 0.008, max = 0.012, per = \"tube\" }\n"));
  EXPECT_EQ(read(write(recipe)), recipe);
  EXPECT_THAT(
      difference(read(set_of_two_kinds("radius = { min = 0.008, max = 0.012 }\nmass = 0.5\n")), recipe),
      ::testing::Optional(HasSubstr("this one { min = 0.008, max = 0.012, per = \"tube\" }")));
}

TEST(RandomizationOfTubes, AnswerForEveryTube) {
  const Recipe recipe = read(set_of_two_kinds(of_each_tube));
  const CaseId id{"A", 3, 1};
  std::vector<DrawnNumber> numbers = draw(recipe, id);
  EXPECT_EQ(numbers.back().tube, 3);
  numbers.pop_back();
  EXPECT_EQ(test::complaint([&] { resolve(recipe, id, numbers); }),
            "set[0].tube[0].cylinders_max: has not been drawn");
}

TEST(RandomizationOfTubes, AreOnlyThoseOfTubes) {
  EXPECT_EQ(
      complaint("[bin]\nheight = { min = 0.2, max = 0.3, per = \"tube\" }\n" + sets),
      "r.toml:2: bin.height: found per = 'tube', expected per = \"scene\", because this number is not a "
      "tube's");
  EXPECT_EQ(complaint("[bin]\nheight = { min = 0.2, max = 0.3, per = \"case\" }\n" + sets),
            "r.toml:2: bin.height: found per = 'case', expected per = \"scene\" or \"tube\"");
  EXPECT_THAT(complaint("[bin]\nheight = { per = \"scene\" }\n" + sets), HasSubstr("a table without min"));
}

// Of a recipe with two kinds of these weights, how many of the tubes of 200 cases are of each.
std::vector<std::size_t> tubes_of_kinds(const Recipe& recipe) {
  std::vector<std::size_t> counts(2);
  for (int number = 1; number <= 200; ++number) {
    const CaseId id{"A", 10, number};
    const SetRecipe set = resolve(recipe, id, draw(recipe, id)).sets[0];
    for (int tube = 1; tube <= id.tubes; ++tube) ++counts[kind_of(set, tube).radius == 0.005 ? 1 : 0];
  }
  return counts;
}

TEST(KindsByWeight, AreDrawnInThisProportion) {
  const std::vector<std::size_t> counts =
      tubes_of_kinds(read(set_of_two_kinds("weight = 3\nradius = 0.01\nmass = 0.5\n", "weight = 1\n")));
  // Three of the first for each of the second: the first's tubes in three equal parts.
  const double expected = 0.75 * 2000;
  const double deviation = std::sqrt(2000 * 0.75 * 0.25);
  EXPECT_NEAR(static_cast<double>(counts[0]), expected, 4 * deviation);
}

TEST(KindsByWeight, AreInTurnWithoutWeights) {
  EXPECT_THAT(tubes_of_kinds(read(set_of_two_kinds("radius = 0.01\nmass = 0.5\n"))),
              ::testing::ElementsAre(1000, 1000));
}

TEST(KindsByWeight, AreRecordedForEachTube) {
  const Recipe recipe = read(set_of_two_kinds("weight = 3\n" + of_each_tube, "weight = 1\n"));
  const CaseId id{"A", 10, 1};
  const std::vector<DrawnNumber> numbers = draw(recipe, id);
  const SetRecipe set = resolve(recipe, id, numbers).sets[0];
  for (int tube = 1; tube <= id.tubes; ++tube) {
    const auto kind = std::ranges::find_if(numbers, [&](const DrawnNumber& number) {
      return number.path == "set[0].tube" && number.tube == tube;
    });
    ASSERT_NE(kind, numbers.end());
    EXPECT_EQ(kind->value, kind_of(set, tube).radius == 0.005 ? 1 : 0);
  }
}

TEST(KindsByWeight, AnUnknownKindIsAnError) {
  const Recipe recipe = read(set_of_two_kinds("weight = 3\nradius = 0.01\nmass = 0.5\n", "weight = 1\n"));
  for (const double kind : {2.0, 0.5, -1.0, 1e300}) {
    EXPECT_THAT(test::complaint([&] {
                  resolve(recipe, {"A", 1, 1}, {{"set[0].tube", kind, 1}});
                }),
                HasSubstr("expected a kind from 0 to 1"));
  }
}

std::string set_of_drawn_size(const std::string& tubes) {
  return "[[set]]\nname = \"A\"\ntubes = " + tubes +
         "\ncases = 100\n[set.tube]\nradius = 0.01\nmass = 0.5\nlength = 0.4\nbend_max_deg = 30\n";
}

TEST(DrawnNumbersOfTubes, DifferFromCaseToCase) {
  const Recipe recipe = read(set_of_drawn_size("{ min = 5, max = 7 }"));
  const std::vector<CaseId> ids = cases(recipe);
  ASSERT_EQ(ids.size(), 100U) << "in all";
  std::vector<std::size_t> counts(3);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    EXPECT_EQ(ids[i].number, static_cast<int>(i) + 1) << "numbered through, whatever the number of tubes";
    ++counts.at(static_cast<std::size_t>(ids[i].tubes - 5));
  }
  EXPECT_GT(test::equal_counts_p(counts), test::significance);
}

TEST(DrawnNumbersOfTubes, DoNotDependOnHowManyCasesThereAre) {
  const Recipe few = read(set_of_drawn_size("{ mean = 10, sigma = 3, min = 1 }"));
  Recipe many = few;
  many.sets[0].cases = 200;
  std::vector<CaseId> first = cases(many);
  first.resize(100);
  EXPECT_EQ(cases(few), first);
}

TEST(DrawnNumbersOfTubes, ComeBackFromTheWrittenRecipe) {
  for (const std::string tubes : {"{ min = 5, max = 15 }", "{ one_of = [5, 10, 20] }",
                                  "{ mean = 10.5, sigma = 2.0, min = 3, max = 18 }"}) {
    const Recipe recipe = read(set_of_drawn_size(tubes));
    EXPECT_THAT(write(recipe), HasSubstr("tubes = " + tubes + "\n"));
    EXPECT_EQ(read(write(recipe)), recipe);
    EXPECT_EQ(cases(read(write(recipe))), cases(recipe));
  }
}

TEST(DrawnNumbersOfTubes, GoTogetherWithOtherNumbers) {
  const Recipe recipe =
      read("[bin]\nheight = { min = 0.2, max = 0.3 }\n" + set_of_drawn_size("{ min = 5, max = 7 }"));
  EXPECT_EQ(read(write(recipe)), recipe);
  const CaseId id = cases(recipe)[0];
  EXPECT_EQ(resolve(recipe, id, draw(recipe, id)).bin.height, drawn(recipe, id).at("bin.height"));
}

TEST(DrawnNumbersOfTubes, SayWhatIsWrong) {
  const auto said = [](const std::string& tubes) { return complaint(set_of_drawn_size(tubes)); };
  EXPECT_EQ(said("{ min = 0, max = 3 }"),
            "r.toml:3: set[0].tubes: found 0, expected a number of tubes from 1 to 1000");
  EXPECT_EQ(said("{ one_of = [3, 1001] }"),
            "r.toml:3: set[0].tubes: found 1001, expected a number of tubes from 1 to 1000");
  EXPECT_EQ(said("{ min = 1.5, max = 3 }"), "r.toml:3: set[0].tubes: found 1.5, expected whole numbers");
  EXPECT_THAT(said("{ min = 1 }"), HasSubstr("r.toml:3: set[0].tubes: found a table without max"));
  EXPECT_THAT(said("{ min = 1, max = 3, per = \"tube\" }"),
              HasSubstr("r.toml:3: set[0].tubes: found per = 'tube'"));
  EXPECT_THAT(said("[{ min = 1, max = 3 }]"), HasSubstr("found a random number, expected a fixed one"));
  EXPECT_THAT(said("{ min = 1, max = 12 }") +
                  complaint(set_of_drawn_size("{ min = 1, max = 12 }") +
                            "[[set]]\nname = \"A1\"\ntubes = [2]\n[set.tube]\n"
                            "radius = 0.01\nmass = 0.5\nlength = 0.4\nbend_max_deg = 3\n"),
              HasSubstr("whose folder A12 also belongs to set 'A'"));
}

// The numbers that this random number of the bin's height gives in many cases.
std::vector<double> heights(const std::string& number) {
  const Recipe recipe = read("[bin]\nheight = " + number + "\n" + sets);
  std::vector<double> all;
  for (int n = 1; n <= 1000; ++n) all.push_back(drawn(recipe, {"A", 1, n}).at("bin.height"));
  return all;
}

// The normal distribution function makes normal numbers uniform.
std::vector<double> quantiles(std::vector<double> numbers, double mean, double sigma) {
  for (double& number : numbers) number = std::erfc((mean - number) / (sigma * std::sqrt(2))) / 2;
  return numbers;
}

TEST(NormalNumbers, HaveTheirMeanAndDeviation) {
  EXPECT_GT(test::uniform_p(quantiles(heights("{ mean = 0.2, sigma = 0.01 }"), 0.2, 0.01), 0, 1),
            test::significance);
}

TEST(NormalNumbers, StayBetweenTheirEnds) {
  const std::vector<double> numbers =
      quantiles(heights("{ mean = 0.2, sigma = 0.01, min = 0.19, max = 0.2 }"), 0.2, 0.01);
  EXPECT_GT(test::uniform_p(numbers, std::erfc(std::sqrt(0.5)) / 2, 0.5), test::significance);
}

TEST(NormalNumbers, AreWholeWhereTheKeysAre) {
  const Recipe recipe = read("[settle]\niterations = { mean = 49.5, sigma = 2 }\n" + sets);
  std::set<double> numbers;
  for (int n = 1; n <= 100; ++n) numbers.insert(drawn(recipe, {"A", 1, n}).at("settle.iterations"));
  EXPECT_GT(numbers.size(), 5U);
  for (const double number : numbers) EXPECT_EQ(number, std::floor(number));
}

TEST(NormalNumbers, AreWrittenWithTheirEnds) {
  const Recipe recipe = read("[bin]\nheight = { mean = 0.25, sigma = 0.015625, max = 0.5 }\n" + sets);
  EXPECT_THAT(write(recipe),
              HasSubstr("height = { mean = 0.25, sigma = 0.015625, min = 0.1875, max = 0.5 }\n"));
  EXPECT_EQ(read(write(recipe)), recipe);
}

TEST(NormalNumbers, SayWhatIsWrong) {
  const auto said = [](const std::string& number) {
    return complaint("[bin]\nheight = " + number + "\n" + sets);
  };
  EXPECT_EQ(said("{ mean = 0.2, sigma = 0 }"),
            "r.toml:2: bin.height: found sigma = 0, expected a positive sigma");
  EXPECT_THAT(said("{ mean = 0.2 }"), HasSubstr("found a table without sigma"));
  EXPECT_THAT(said("{ mean = 0.2, sigma = 0.1, one_of = [1] }"), HasSubstr("found a table with 'mean'"));
  std::string values = "0.2";
  for (int i = 1; i < 1000; ++i) values += ", 0.2";
  EXPECT_EQ(said("{ one_of = [" + values + "] }"), "none");
  EXPECT_EQ(said("{ one_of = [" + values + ", 0.2] }"),
            "r.toml:2: bin.height: found one_of with 1001 numbers, expected at most 1000");
  EXPECT_THAT(said("{ mean = 0.2, sigma = 0.1, median = 1 }"), HasSubstr("found a table with 'median'"));
  EXPECT_THAT(said("{ mean = inf, sigma = 0.1 }"), HasSubstr("found inf, expected finite numbers"));
  EXPECT_THAT(said("{ mean = 0.2, sigma = 0.01, min = 0.3 }"),
              HasSubstr("found min = 0.3 and max = 0.24, expected the mean, 0.2, between ends"));
  EXPECT_THAT(said("{ mean = 0.2, sigma = 1, min = 0.19, max = 0.21 }"),
              HasSubstr("a tenth of sigma or more apart"));
  EXPECT_EQ(said("{ mean = 0.2, sigma = 0.1 }"),
            "r.toml:2: bin.height: found -0.2, expected a finite positive number")
      << "both ends must make a recipe";
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
      EXPECT_EQ(resolve(again, id, draw(again, id)), resolve(recipe, id, draw(recipe, id)));
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
  const std::string fixed = set_of_two_kinds("radius = 0.01\nmass = 0.5\n");
  const Recipe recipe = read("[settle]\niterations = { min = 10, max = 20 }\n" + fixed);
  for (const double number : {10.5, 1e300, -1e300})
    EXPECT_THAT(test::complaint([&] {
                  resolve(recipe, {"A", 1, 1}, {{"settle.iterations", number}});
                }),
                HasSubstr("settle.iterations: found"));
  EXPECT_EQ(test::complaint([&] {
              resolve(recipe, {"A", 1, 1}, {});
            }),
            "settle.iterations: has not been drawn");
}

TEST(Randomization, WhatIsDrawnCannotBeSetInCode) {
  Recipe recipe = read(R"([scanner]
look_at = [0, 0, 0]
distance = { min = 1.5, max = 2 }
[[set]]
name = "A"
tubes = [2]
tube = { radius = { min = 0.01, max = 0.02 }, mass = 0.5, length = 0.5, bend_max_deg = 30 }
)");
  recipe.seed = 5;
  recipe.sets[0].cases = 3;
  recipe.sets[0].kinds[0].mass = 0.7;
  EXPECT_EQ(test::complaint([&] { validate(recipe); }), "none");
  Recipe thin = recipe;
  thin.sets[0].kinds[0].radius = 0.005;
  EXPECT_EQ(
      test::complaint([&] { validate(thin); }),
      "set[0].tube.radius: found 0.005, expected 0.01, the lowest that cases draw: what is drawn cannot "
      "be set in code, only in the recipe's text");
  Recipe moved = recipe;
  moved.camera.pose.translation().z() = 3;
  EXPECT_THAT(test::complaint([&] { validate(moved); }), HasSubstr("what is drawn cannot be set in code"));
}

TEST(Randomization, ARecipeWithoutRangesDrawsNothing) {
  const Recipe recipe = read(
      "[[set]]\nname = \"A\"\ntubes = [1]\n[set.tube]\nradius = 0.0125\nmass = 0.5\n"
      "length = 0.5\nbend_max_deg = 30\n");
  EXPECT_TRUE(draw(recipe, {"A", 1, 1}).empty());
  EXPECT_EQ(write(resolve(recipe, {"A", 1, 1}, {})), write(recipe));
}

TEST(Randomization, SaysWhichRangeIsWrongAndWhatToDo) {
  EXPECT_EQ(complaint("[bin]\n\nheight = { min = 0.3, max = 0.2 }\n" + sets),
            "r.toml:3: bin.height: found min = 0.3 and max = 0.2, expected min to be at most max");
  EXPECT_THAT(
      complaint("[bin]\nheight = { min = 0.3 }\n" + sets),
      HasSubstr("r.toml:2: bin.height: found a table without max, expected { min = NUMBER, max = NUMBER }"));
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
