#include "tanglebin/simulate/simulate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <stdexcept>

#include "tanglebin/base/error.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tests/dataset/small_recipe.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using test::small_recipe;

std::string text_of(const std::vector<Tube>& tubes) {
  std::ostringstream out;
  write_configuration(out, tubes);
  return out.str();
}

std::set<std::int32_t> labels_of(const Scan& scan) {
  std::set<std::int32_t> labels;
  for (const Pixel& pixel : scan.pixels) labels.insert(pixel.label);
  return labels;
}

TEST(Simulate, GivesTheTubesAskedForAndAScanThatSeesThem) {
  const Recipe recipe = small_recipe();
  const SimulatedScene scene = simulate(recipe, {"A", 3, 1});
  ASSERT_EQ(scene.tubes.size(), 3U);
  for (int id = 1; id <= 3; ++id) EXPECT_EQ(scene.tubes[static_cast<std::size_t>(id - 1)].id, id);
  EXPECT_LE(scene.largest_overlap, recipe.settle.overlap_max);
  EXPECT_GT(scene.simulated, recipe.settle.proof_time);
  EXPECT_THAT(labels_of(scene.scan), testing::IsSupersetOf({0, 1, 2, 3}));
}

TEST(Simulate, TakesKindsOfTubesInTurn) {
  Recipe recipe = small_recipe();
  TubeSpec thin = recipe.sets[0].kinds[0];
  thin.radius = 0.008;
  thin.mass = 0.2;
  recipe.sets[0].kinds.push_back(thin);
  const SimulatedScene scene = simulate(recipe, {"A", 3, 1});
  ASSERT_EQ(scene.tubes.size(), 3U);
  for (const Tube& tube : scene.tubes) EXPECT_EQ(tube.radius, tube.id == 2 ? 0.008 : 0.0125) << tube.id;
  EXPECT_THAT(labels_of(scene.scan), testing::IsSupersetOf({0, 1, 2, 3}));
}

TEST(Simulate, ACaseIsTheSameWhateverWasSimulatedBefore) {
  const Recipe recipe = small_recipe();
  const std::string first = text_of(simulate(recipe, {"A", 3, 1}).tubes);
  const std::string other = text_of(simulate(recipe, {"A", 3, 2}).tubes);
  EXPECT_EQ(text_of(simulate(recipe, {"A", 3, 1}).tubes), first);
  EXPECT_NE(other, first);
}

TEST(Simulate, TheTextFormatHoldsTheSceneExactly) {
  const Recipe recipe = small_recipe();
  const SimulatedScene scene = simulate(recipe, {"A", 3, 2});
  std::istringstream text(text_of(scene.tubes));
  const std::vector<Tube> read = read_configuration(text, "scene");
  ASSERT_EQ(text_of(read), text.str());
  const Scan again = scan(read, recipe.bin, recipe.camera);
  ASSERT_EQ(again.pixels.size(), scene.scan.pixels.size());
  for (std::size_t i = 0; i < again.pixels.size(); ++i) {
    ASSERT_EQ(again.pixels[i].label, scene.scan.pixels[i].label);
    if (again.pixels[i].label == null_label) continue;
    ASSERT_EQ(again.pixels[i].point, scene.scan.pixels[i].point);
  }
}

TEST(Simulate, TellsWhatWasTriedWhenNoAttemptIsValid) {
  Recipe recipe = small_recipe();
  recipe.attempts = 4;
  recipe.settle.time_limit = 0.1;  // the tubes are still in the air
  try {
    simulate(recipe, {"A", 3, 1});
    FAIL() << "a heap cannot rest in the air";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "A3/1: no valid scene of 3 tubes in 4 attempts: 4 x no rest: the heap never slowed down; "
                 "try fewer tubes, a larger bin or more attempts");
  }
}

TEST(Simulate, GivesUpAfterAQuarterOfTheAttemptsIfTheTubesFallOutInEach) {
  Recipe recipe = small_recipe();
  recipe.attempts = 8;
  recipe.bin.width = 0.1;
  recipe.bin.height = 0.01;
  int attempts = 0;
  EXPECT_THAT(test::complaint([&] {
                simulate(recipe, {"A", 12, 1}, [&] { ++attempts; });
              }),
              testing::HasSubstr("no valid scene of 12 tubes in 2 attempts: 2 x a tube left the bin; "));
  EXPECT_EQ(attempts, 2);
}

TEST(Simulate, IsEndedBetweenAttemptsByWhatItsCallerThrows) {
  Recipe recipe = small_recipe();
  recipe.settle.time_limit = 0.1;  // no attempt succeeds
  int attempts = 0;
  const auto stop_at_the_third = [&] {
    if (++attempts == 3) throw std::runtime_error("stopped");
  };
  EXPECT_THROW(simulate(recipe, {"A", 3, 1}, stop_at_the_third), std::runtime_error);
  EXPECT_EQ(attempts, 3);
}

TEST(Simulate, IsEndedWithinAnAttemptByWhatItsCallerThrows) {
  double last = 0;
  const auto stop_after_a_tenth = [&](double simulated) {
    last = simulated;
    if (simulated > 0.1) throw std::runtime_error("stop");
  };
  EXPECT_THROW(simulate(
                   small_recipe(), {"A", 3, 1}, [] {}, stop_after_a_tenth),
               std::runtime_error);
  EXPECT_NEAR(last, 0.1, 0.003);
}

TEST(Simulate, KnowsOnlyTheRecipesSets) {
  EXPECT_THROW(simulate(small_recipe(), {"B", 1, 1}), InputError);
}

TEST(Simulate, TheSensorsNoiseFollowsFromTheScenesSeed) {
  Recipe recipe = test::small_recipe();
  recipe.sensor.sigma = 0.001;
  const SimulatedScene scene = simulate(recipe, {"A", 3, 1});
  const Scan again = scan(scene.tubes, recipe.bin, recipe.camera, recipe.sensor, scene.seed);
  ASSERT_EQ(again.pixels.size(), scene.scan.pixels.size());
  for (std::size_t i = 0; i < again.pixels.size(); ++i) {
    EXPECT_EQ(again.pixels[i].label, scene.scan.pixels[i].label);
    if (again.pixels[i].label == null_label) continue;
    EXPECT_EQ(again.pixels[i].point, scene.scan.pixels[i].point);
  }
}

TEST(Simulate, TwoScannersOfASceneSeeTheSameTubesEachWithItsOwnNoise) {
  Recipe recipe = small_recipe();
  recipe.sensor = {.sigma = 0.001, .signal = true};
  recipe.scanner_name = "left";
  recipe.further_scanners = {{"right", recipe.camera, recipe.sensor}};
  const SimulatedScene scene = simulate(recipe, {"A", 3, 1});
  const Scan& left = scene.scan;
  const Scan& right = scene.further_scans.at(0);
  EXPECT_EQ(left.snr, right.snr) << "of the same albedo and gloss";
  int points = 0;
  int same = 0;
  for (std::size_t i = 0; i < left.pixels.size(); ++i) {
    ASSERT_EQ(left.pixels[i].label, right.pixels[i].label);
    if (left.pixels[i].label == null_label) continue;
    ++points;
    same += left.pixels[i].range == right.pixels[i].range ? 1 : 0;
  }
  EXPECT_LT(same, points / 100);
}

}  // namespace
}  // namespace tanglebin
