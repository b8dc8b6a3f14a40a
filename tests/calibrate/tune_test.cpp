#include "tanglebin/calibrate/tune.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tanglebin/base/counter_random.hpp"

namespace tanglebin {
namespace {

using testing::Each;
using testing::IsEmpty;
using testing::Not;

Parameter parameter_named(const std::string& name) {
  const std::vector<Parameter> all = declared_parameters();
  return *std::ranges::find(all, name, &Parameter::name);
}

/// Scores that are greatest where some parameters have known values; the others do not matter. The scenes
/// differ in how hard they are, and in how much a parameter matters.
class Landscape {
public:
  explicit Landscape(Parameters peak) : peak_(std::move(peak)) {}

  Scorer scorer() const {
    return [this](const Parameters& parameters, const std::vector<std::size_t>& scenes) {
      std::vector<double> scores;
      for (const std::size_t scene : scenes) scores.push_back(score(parameters, scene));
      return scores;
    };
  }

private:
  double score(const Parameters& parameters, std::size_t scene) const {
    const CounterRandom random(7, scene);
    double value = 1 - 0.2 * random.uniform(0);
    std::uint64_t number = 0;
    for (const auto& [name, best] : peak_) {
      const Parameter parameter = parameter_named(name);
      const auto found = parameters.find(name);
      const double here = found == parameters.end() ? parameter.standard : found->second;
      const double distance = place_of(parameter, here) - place_of(parameter, best);
      value -= (0.5 + random.uniform(++number)) * distance * distance;
    }
    return value;
  }

  Parameters peak_;
};

constexpr std::size_t scenes_to_tune = 20;

TEST(Places, AreTheInverseOfValues) {
  const Parameter by_factors = parameter_named("paper.fit.trim");
  EXPECT_EQ(value_at(by_factors, 0), by_factors.range->least);
  EXPECT_EQ(value_at(by_factors, 1), by_factors.range->greatest);
  EXPECT_NEAR(value_at(by_factors, 0.5), std::sqrt(by_factors.range->least * by_factors.range->greatest),
              1e-5);
  EXPECT_NEAR(place_of(by_factors, value_at(by_factors, 0.3)), 0.3, 1e-3);
  const Parameter by_steps = parameter_named("axis.link.chain_prior");
  EXPECT_NEAR(value_at(by_steps, 0.25), 8, 1e-9);
  EXPECT_NEAR(place_of(by_steps, 8), 0.25, 1e-9);
  EXPECT_EQ(value_at(by_steps, 7.0), by_steps.range->greatest);
  EXPECT_EQ(value_at(parameter_named("paper.normal_neighbours"), 0.512), 16);
}

TEST(Places, OfDefaultsLeadBackToThem) {
  for (const Parameter& parameter : declared_parameters()) {
    if (!parameter.range) continue;
    EXPECT_EQ(value_at(parameter, place_of(parameter, parameter.standard)), parameter.standard)
        << parameter.name;
  }
}

TEST(TunableParameters, AreThoseOfTheMethodButForTheWeightsThatAreLearned) {
  std::vector<std::string> names;
  for (const Parameter& parameter : tunable_parameters(Method::axis)) names.push_back(parameter.name);
  EXPECT_THAT(names, Each(testing::StartsWith("axis.")));
  EXPECT_THAT(names, testing::Contains("axis.link.chain_prior"));
  EXPECT_THAT(names, Each(Not(testing::HasSubstr("weights"))));
  EXPECT_EQ(tunable_parameters(Method::paper).size(), 22U);
}

TEST(Sensitivities, TellWhichWayHelpsAndWhatDoesNotMatter) {
  const Landscape landscape({{"paper.fit.trim", 0.008}});
  const Race race(landscape.scorer(), scenes_to_tune, {});
  const std::vector<Sensitivity> seen = sensitivities(
      race, {parameter_named("paper.fit.trim"), parameter_named("paper.fit.gap_max")}, 0.1, Look::heat);
  EXPECT_GT(seen[0].up, 0);
  EXPECT_LT(seen[0].down, 0);
  EXPECT_EQ(seen[1].up, 0);
  EXPECT_EQ(seen[1].down, 0);
}

TEST(Tuning, FindsTheBestValuesOfThoseThatMatter) {
  const Parameters peak{{"paper.fit.trim", 0.009},
                        {"paper.fit.distance_max", 0.001},
                        {"paper.join.angle_max", 3.5},
                        {"paper.segment.neighbours", 30}};
  const Landscape landscape(peak);
  Race race(landscape.scorer(), scenes_to_tune, {});
  tune(race, tunable_parameters(Method::paper));
  for (const auto& [name, value] : peak) {
    const Parameter parameter = parameter_named(name);
    ASSERT_TRUE(race.best().contains(name)) << name;
    EXPECT_NEAR(place_of(parameter, race.best().at(name)), place_of(parameter, value), 0.03) << name;
  }
}

TEST(Tuning, ComesBackFromParametersThatAreHalvedOrDoubled) {
  Parameters peak;
  Parameters start;
  double factor = 2;
  for (const Parameter& parameter : tunable_parameters(Method::paper)) {
    if (!parameter.range->by_factors || parameter.is_whole) continue;
    peak[parameter.name] = parameter.standard;
    start[parameter.name] = parameter.standard * factor;
    factor = 1 / factor;
  }
  const Landscape landscape(peak);
  const double greatest = Race(landscape.scorer(), scenes_to_tune, {}).score();
  Race race(landscape.scorer(), scenes_to_tune, start);
  const double before = race.score();
  tune(race, tunable_parameters(Method::paper));
  EXPECT_LT(greatest - race.score(), 0.1 * (greatest - before));
}

TEST(Tuning, GainsWithFewEvaluations) {
  const Landscape landscape({{"paper.fit.trim", 0.009}, {"paper.join.angle_max", 3.5}});
  const Scorer scorer = landscape.scorer();
  std::size_t left = 200;
  Race race(
      [&](const Parameters& parameters, const std::vector<std::size_t>& scenes) {
        if (scenes.size() > left) throw std::runtime_error("no more");
        left -= scenes.size();
        return scorer(parameters, scenes);
      },
      scenes_to_tune, {});
  const double before = race.score();
  EXPECT_THROW(tune(race, tunable_parameters(Method::paper)), std::runtime_error);
  EXPECT_GT(race.score(), before + 0.03);
}

TEST(Tuning, LeavesEverythingWhereNothingMatters) {
  const Landscape flat({});
  Race race(flat.scorer(), scenes_to_tune, {});
  tune(race, tunable_parameters(Method::axis));
  EXPECT_THAT(race.best(), IsEmpty());
}

TEST(KeepingWhatHelps, PutsTheRestBackToTheStart) {
  const Landscape landscape({{"paper.fit.trim", 0.008}});
  const Parameters start{{"paper.fit.gap_max", 0.03}};
  Race race(landscape.scorer(), scenes_to_tune,
            {{"paper.fit.trim", 0.008}, {"paper.fit.gap_max", 0.05}, {"paper.fit.points_min", 20}});
  keep_what_helps(race, start);
  EXPECT_EQ(race.best(), (Parameters{{"paper.fit.trim", 0.008}, {"paper.fit.gap_max", 0.03}}));
}

TEST(KeepingWhatHelps, TakesTheWeightsOfLinksAsOne) {
  const Parameters with_weights{{"axis.link.weights.chain_ends.gap", 1},
                                {"axis.link.weights.junction.gap", 2}};
  std::vector<Parameters> asked;
  Race race(
      [&](const Parameters& parameters, const std::vector<std::size_t>& scenes) {
        asked.push_back(parameters);
        return std::vector<double>(scenes.size(), parameters.empty() ? 0.2 : 0.3);
      },
      1, with_weights);
  keep_what_helps(race, {});
  EXPECT_THAT(asked, testing::ElementsAre(with_weights, Parameters()));
  EXPECT_EQ(race.best(), with_weights);
}

}  // namespace
}  // namespace tanglebin
