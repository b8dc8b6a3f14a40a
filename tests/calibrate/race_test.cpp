#include "tanglebin/calibrate/race.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace tanglebin {
namespace {

constexpr std::size_t scenes_of_race = 40;

/// Scores that are known: scene i is 0.01 (i mod 7) harder than the first, and the parameter "gain" adds
/// itself.
class KnownScores {
public:
  std::size_t made = 0;

  Scorer scorer() {
    return [this](const Parameters& parameters, const std::vector<std::size_t>& scenes) {
      std::vector<double> scores;
      for (const std::size_t scene : scenes) scores.push_back(score(parameters, scene));
      made += scenes.size();
      return scores;
    };
  }

private:
  static double score(const Parameters& parameters, std::size_t scene) {
    const auto gain = parameters.find("gain");
    const auto late_gain = parameters.find("late_gain");
    double value = 0.5 - 0.01 * static_cast<double>(scene % 7);
    if (gain != parameters.end()) value += gain->second;
    if (late_gain != parameters.end() && scene >= 10) value += late_gain->second;
    return value;
  }
};

TEST(Race, DropsABadCandidateAfterTheFirstHeat) {
  KnownScores known;
  Race race(known.scorer(), scenes_of_race, {});
  known.made = 0;
  const double mean = race.run({{"gain", -0.1}});
  EXPECT_EQ(known.made, scenes_of_heat);
  EXPECT_NEAR(mean, race.score() - 0.1, 1e-12);
  EXPECT_EQ(race.best(), Parameters());
}

TEST(Race, DropsACandidateThatFallsBackLater) {
  KnownScores known;
  Race race(known.scorer(), scenes_of_race, {});
  known.made = 0;
  race.run({{"late_gain", -0.1}});
  EXPECT_EQ(known.made, 2 * scenes_of_heat);
  EXPECT_EQ(race.best(), Parameters());
}

TEST(Race, TakesABetterCandidateAfterAllScenes) {
  KnownScores known;
  Race race(known.scorer(), scenes_of_race, {});
  const double before = race.score();
  known.made = 0;
  race.run({{"gain", 0.1}});
  EXPECT_EQ(known.made, scenes_of_race);
  EXPECT_EQ(race.best(), (Parameters{{"gain", 0.1}}));
  EXPECT_NEAR(race.score(), before + 0.1, 1e-12);
}

TEST(Race, KeepsTheBestIfACandidateIsJustAsGoodUnlessAskedTo) {
  KnownScores known;
  Race race(known.scorer(), scenes_of_race, {});
  race.run({{"other", 1}});
  EXPECT_EQ(race.best(), Parameters());
  EXPECT_TRUE(race.take_if_as_good({{"other", 1}}));
  EXPECT_EQ(race.best(), (Parameters{{"other", 1}}));
  EXPECT_FALSE(race.take_if_as_good({{"gain", -0.1}}));
  EXPECT_EQ(race.best(), (Parameters{{"other", 1}}));
}

TEST(Race, LooksAtTheFirstHeatOnly) {
  KnownScores known;
  const Race race(known.scorer(), scenes_of_race, {});
  known.made = 0;
  EXPECT_NEAR(race.advantage({{"gain", 0.2}}, Look::heat), 0.2, 1e-12);
  EXPECT_NEAR(race.advantage({{"late_gain", 0.2}}, Look::heat), 0, 1e-12);
  EXPECT_EQ(known.made, 2 * scenes_of_heat);
}

TEST(Race, GlancesAtScenesThatLoseSomethingButNotAll) {
  const std::vector<double> first{1, 0.7, 1, 0, 0.8, 1};
  std::vector<std::size_t> glanced_at;
  const Race race(
      [&](const Parameters& /*parameters*/, const std::vector<std::size_t>& scenes) {
        glanced_at = scenes;
        std::vector<double> scores;
        for (const std::size_t scene : scenes) scores.push_back(first[scene]);
        return scores;
      },
      first.size(), {});
  race.advantage({}, Look::glance);
  EXPECT_EQ(glanced_at, (std::vector<std::size_t>{1, 3}));  // the mean is 0.75
}

TEST(Race, ComparesFewerScenesThanAHeat) {
  KnownScores known;
  Race race(known.scorer(), 3, {});
  race.run({{"gain", 0.1}});
  EXPECT_EQ(race.best(), (Parameters{{"gain", 0.1}}));
}

TEST(Race, KeepsTheBestWhenScoringEnds) {
  KnownScores known;
  const Scorer scorer = known.scorer();
  Race race(
      [&](const Parameters& parameters, const std::vector<std::size_t>& scenes) {
        if (known.made >= 2 * scenes_of_race + scenes_of_heat) throw std::runtime_error("no more");
        return scorer(parameters, scenes);
      },
      scenes_of_race, {});
  race.run({{"gain", 0.1}});
  EXPECT_THROW(race.run({{"gain", 0.2}}), std::runtime_error);
  EXPECT_EQ(race.best(), (Parameters{{"gain", 0.1}}));
}

}  // namespace
}  // namespace tanglebin
