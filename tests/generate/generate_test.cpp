#include "tanglebin/generate/generate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tests/geometry/example_tubes.hpp"
#include "tests/support/statistics.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using test::chain_spec;
using test::equal_counts_p;
using test::radians;
using test::rounding;
using test::same_distribution_p;
using test::significance;
using test::tree_spec;
using test::tube_through;
using test::uniform_p;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double shortest = 0.02;  // m, of every cylinder of the sets
constexpr int many = 10000;

// A chain of cylinders between two named nodes, as drawn or as published.
struct Chain {
  std::vector<Vector3d> directions;  // unit
  std::vector<double> lengths;       // m
};

std::vector<Chain> chains(const Tube& tube) {
  std::vector<Chain> result;
  for (const Edge& edge : tube.edges) {
    if (edge.order == 1) result.emplace_back();
    const Vector3d along = tube.nodes[edge.to].position - tube.nodes[edge.from].position;
    result.back().directions.push_back(along.normalized());
    result.back().lengths.push_back(along.norm());
  }
  return result;
}

std::vector<Chain> drawn_chains(const TubeSpec& spec, int tubes, std::uint64_t seed = 1) {
  Rng rng(seed);
  std::vector<Chain> result;
  for (int id = 1; id <= tubes; ++id)
    std::ranges::move(chains(draw_tube(rng, spec, id)), std::back_inserter(result));
  return result;
}

double angle_between(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double azimuth(const Vector3d& direction) {
  return std::atan2(direction.y(), direction.x());
}

std::vector<double> bends(const std::vector<Chain>& all) {
  std::vector<double> result;
  for (const Chain& chain : all) {
    for (std::size_t i = 1; i < chain.directions.size(); ++i) {
      result.push_back(angle_between(chain.directions[i - 1], chain.directions[i]));
    }
  }
  return result;
}

std::vector<double> bend_azimuths(const std::vector<Chain>& all) {
  std::vector<double> result;
  for (const Chain& chain : all) {
    for (std::size_t i = 1; i < chain.directions.size(); ++i) {
      const auto to_z = Eigen::Quaterniond::FromTwoVectors(chain.directions[i - 1], Vector3d::UnitZ());
      result.push_back(azimuth(to_z * chain.directions[i]));
    }
  }
  return result;
}

// The lengths of every chain's n-th cylinder, from 0; from its last one backwards for n below 0.
std::vector<double> nth_lengths(const std::vector<Chain>& all, int n) {
  std::vector<double> result;
  for (const Chain& chain : all) {
    const int size = static_cast<int>(chain.lengths.size());
    if (n < size) result.push_back(chain.lengths[static_cast<std::size_t>(n < 0 ? n + size : n)]);
  }
  return result;
}

// Where each cylinder's length lies in the range that the ones before it left (Algorithm 2, line 4), from 0
// to 1. Cylinders without a choice say nothing: the last one, and those whose range is less than the
// published files' six digits tell.
std::vector<double> shares_of_range(const std::vector<Chain>& all) {
  std::vector<double> result;
  for (const Chain& chain : all) {
    double remaining = std::accumulate(chain.lengths.begin(), chain.lengths.end(), 0.0);
    for (std::size_t i = 0; i + 1 < chain.lengths.size(); ++i) {
      const double longest = remaining - static_cast<double>(chain.lengths.size() - 1 - i) * shortest;
      if (longest - shortest > 1e-4) result.push_back((chain.lengths[i] - shortest) / (longest - shortest));
      remaining -= chain.lengths[i];
    }
  }
  return result;
}

std::vector<std::size_t> counts_of_cylinders(const std::vector<Chain>& all, std::size_t low,
                                             std::size_t high) {
  std::vector<std::size_t> counts(high - low + 1);
  for (const Chain& chain : all) ++counts.at(chain.lengths.size() - low);
  return counts;
}

// ---- Algorithm 2

RC_GTEST_PROP(DrawLengths, AddUpToTheTotalAndKeepTheShortest, (std::uint64_t seed)) {
  Rng rng(seed);
  const int cylinders = *rc::gen::inRange(1, 51);
  const double least = uniform_real(rng, 0.001, 0.05);
  const double total = cylinders * least * uniform_real(rng, 1, 3);
  const std::vector<double> lengths = draw_lengths(rng, cylinders, total, least);
  RC_ASSERT(lengths.size() == static_cast<std::size_t>(cylinders));
  RC_ASSERT(std::abs(std::accumulate(lengths.begin(), lengths.end(), -total)) < rounding);
  RC_ASSERT(*std::ranges::min_element(lengths) > least - rounding);
}

TEST(DrawLengths, GiveOneCylinderTheWholeLength) {
  Rng rng(1);
  EXPECT_THAT(draw_lengths(rng, 1, 0.5, 0.02), ElementsAre(0.5));
}

TEST(DrawLengths, AreAllTheShortestWhereThatLeavesNoChoice) {
  Rng rng(1);
  for (int cylinders = 2; cylinders <= 100; ++cylinders) {
    for (const double length : draw_lengths(rng, cylinders, cylinders * 0.1, 0.1)) {
      EXPECT_NEAR(length, 0.1, rounding);
    }
  }
}

TEST(DrawLengths, AreUniformInWhatTheCylindersBeforeLeave) {
  Rng rng(1);
  std::vector<Chain> all(many);
  for (Chain& chain : all) chain.lengths = draw_lengths(rng, 7, 0.5, shortest);
  EXPECT_GT(uniform_p(nth_lengths(all, 0), 0.02, 0.5 - 6 * 0.02), significance);
  EXPECT_GT(uniform_p(shares_of_range(all), 0, 1), significance);
}

// ---- Algorithm 3

TEST(DrawEndpoints, StartAtTheOriginAndLieTheirLengthsApart) {
  Rng rng(1);
  const std::vector<double> lengths{0.1, 0.02, 0.3};
  const std::vector<Vector3d> endpoints = draw_endpoints(rng, lengths, 0, pi);
  ASSERT_EQ(endpoints.size(), 4U);
  EXPECT_EQ(endpoints[0], Vector3d(0, 0, 0));
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    EXPECT_NEAR((endpoints[i + 1] - endpoints[i]).norm(), lengths[i], rounding);
  }
}

// Near a pole the rotation from z onto the direction loses its digits where it is computed carelessly. Of
// 200,000 first directions the nearest to a pole is about 1e-5 from it.
TEST(DrawEndpoints, BendExactlyByTheAngleAskedForEvenNearThePoles) {
  Rng rng(1);
  double nearest_to_pole = pi;
  for (const double bend : {0.0, 0.3, pi / 2, 3.0, pi}) {
    for (int i = 0; i < 40000; ++i) {
      const std::vector<Vector3d> points = draw_endpoints(rng, {1, 1, 1}, bend, bend);
      const Vector3d first = points[1] - points[0];
      nearest_to_pole = std::min(nearest_to_pole, std::hypot(first.x(), first.y()));
      for (std::size_t k = 1; k + 1 < points.size(); ++k) {
        ASSERT_NEAR(angle_between(points[k] - points[k - 1], points[k + 1] - points[k]), bend, 1e-10);
        ASSERT_NEAR((points[k + 1] - points[k]).norm(), 1, rounding);
      }
    }
  }
  EXPECT_LT(nearest_to_pole, 1e-4);
}

// ---- Algorithm 1: what 10,000 tubes of the sets A and B look like

class ManyTubes : public testing::TestWithParam<double> {
protected:
  double bend_max_deg() const { return GetParam(); }
  std::vector<Chain> draw() const { return drawn_chains(chain_spec(bend_max_deg()), many); }
};

INSTANTIATE_TEST_SUITE_P(SetsAAndB, ManyTubes, testing::Values(30.0, 45.0));

TEST_P(ManyTubes, HaveUniformNumbersOfCylinders) {
  EXPECT_GT(equal_counts_p(counts_of_cylinders(draw(), 5, 10)), significance);
}

TEST_P(ManyTubes, AreExactlyAsLongAsAskedFor) {
  for (const Chain& chain : draw()) {
    EXPECT_NEAR(std::accumulate(chain.lengths.begin(), chain.lengths.end(), 0.0), 0.5, 1e-6);
    EXPECT_GT(*std::ranges::min_element(chain.lengths), shortest - rounding);
  }
}

TEST_P(ManyTubes, HaveLengthsUniformInWhatRemains) {
  std::vector<Chain> all = draw();
  EXPECT_GT(uniform_p(shares_of_range(all), 0, 1), significance);
  for (std::size_t cylinders = 5; cylinders <= 10; ++cylinders) {
    std::vector<Chain> alike;
    std::ranges::copy_if(all, std::back_inserter(alike),
                         [&](const Chain& chain) { return chain.lengths.size() == cylinders; });
    const double longest = 0.5 - static_cast<double>(cylinders - 1) * shortest;
    EXPECT_GT(uniform_p(nth_lengths(alike, 0), shortest, longest), significance) << cylinders << " cylinders";
  }
}

TEST_P(ManyTubes, BendUniformlyInTheirRange) {
  const std::vector<double> all = bends(draw());
  EXPECT_GT(uniform_p(all, 0, radians(bend_max_deg())), significance);
  EXPECT_LT(uniform_p(all, 0, radians(bend_max_deg() + 1)), significance) << "the test sees one degree more";
}

TEST_P(ManyTubes, BendTowardsAllSides) {
  EXPECT_GT(uniform_p(bend_azimuths(draw()), -pi, pi), significance);
}

// The paper's line 6: the polar angle is uniform, so that directions crowd at the poles.
TEST_P(ManyTubes, StartInDirectionsOfUniformPolarAngleAndAzimuth) {
  std::vector<double> polar_angles;
  std::vector<double> azimuths;
  for (const Chain& chain : draw()) {
    polar_angles.push_back(angle_between(Vector3d::UnitZ(), chain.directions.front()));
    azimuths.push_back(azimuth(chain.directions.front()));
  }
  EXPECT_GT(uniform_p(polar_angles, 0, pi), significance);
  EXPECT_GT(uniform_p(azimuths, -pi, pi), significance);
}

TEST_P(ManyTubes, FollowFromTheSeedAlone) {
  const std::vector<Chain> first = drawn_chains(chain_spec(bend_max_deg()), 20, 7);
  const std::vector<Chain> again = drawn_chains(chain_spec(bend_max_deg()), 20, 7);
  const std::vector<Chain> other = drawn_chains(chain_spec(bend_max_deg()), 20, 8);
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].lengths, again[i].lengths);
  EXPECT_NE(first.front().lengths, other.front().lengths);
}

// ---- Algorithm 1: how a tube is put together

TEST(DrawTube, TakesItsNumbersFromTheSpec) {
  Rng rng(1);
  TubeSpec spec = chain_spec(30);
  spec.radius = 0.01;
  spec.mass = 0.3;
  const Tube tube = draw_tube(rng, spec, 17);
  EXPECT_EQ(tube.id, 17);
  EXPECT_EQ(tube.radius, 0.01);
  EXPECT_EQ(tube.mass, 0.3);
}

std::vector<int> ids_along(const Tube& tube) {
  std::vector<int> ids{tube.nodes[tube.edges.front().from].id};
  for (const Edge& edge : tube.edges) ids.push_back(tube.nodes[edge.to].id);
  return ids;
}

TEST(DrawTube, NumbersAChainLikeThePublishedFiles) {
  Rng rng(1);
  TubeSpec spec = chain_spec(30);
  spec.segments.front().cylinders_min = spec.segments.front().cylinders_max = 5;
  const Tube tube = draw_tube(rng, spec, 1);
  EXPECT_THAT(ids_along(tube), ElementsAre(1, 4, 5, 6, 7, 2));
  EXPECT_EQ(tube.nodes.front().position, Vector3d(0, 0, 0));
}

TEST(DrawTube, NumbersATreeLikeThePublishedFiles) {
  Rng rng(1);
  TubeSpec spec = tree_spec();
  for (SegmentSpec& segment : spec.segments) segment.cylinders_min = segment.cylinders_max = 3;
  const Tube tube = draw_tube(rng, spec, 1);
  EXPECT_THAT(ids_along(tube), ElementsAre(1, 8, 9, 2, 10, 11, 3, 12, 13, 4, 14, 15, 5, 16, 17, 6));

  std::vector<int> orders;
  for (const Edge& edge : tube.edges) orders.push_back(edge.order);
  EXPECT_THAT(orders, ElementsAre(1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3));
}

TEST(DrawTube, JoinsTheSegmentsOfATreeAtItsJunctions) {
  Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const Tube tube = draw_tube(rng, tree_spec(), 1);
    ASSERT_EQ(tube.nodes.size(), tube.edges.size() + 1);
    std::map<int, int> degrees;
    for (const Edge& edge : tube.edges) {
      ++degrees[tube.nodes[edge.from].id];
      ++degrees[tube.nodes[edge.to].id];
    }
    for (const auto& [id, degree] : degrees)
      EXPECT_EQ(degree, id <= 2 ? 3 : id <= 6 ? 1 : 2) << "node " << id;

    std::vector<double> lengths;
    for (const Chain& chain : chains(tube)) {
      lengths.push_back(std::accumulate(chain.lengths.begin(), chain.lengths.end(), 0.0));
    }
    EXPECT_THAT(lengths, testing::Pointwise(testing::DoubleNear(1e-9), {0.3, 0.1, 0.1, 0.1, 0.15}));
  }
}

TEST(DrawTube, NeverPassesThroughItself) {
  Rng rng(1);
  for (const TubeSpec& spec : {chain_spec(120), tree_spec()}) {
    for (int i = 0; i < 1000; ++i) EXPECT_FALSE(passes_through_itself(draw_tube(rng, spec, 1)));
  }
}

TEST(DrawTube, HasTheMassOfASolidOfItsDensity) {
  TubeSpec spec;
  spec.mass = 0;
  spec.density = 1000;
  spec.segments = {{{1, 2, 0.3}, 1, 1, 0.1, 0, 0}};
  Rng rng(1);
  const double r = spec.radius;
  const double volume =
      pi * r * r * 0.3 + 4 * pi * r * r * r / 3;  // a cylinder and a hemisphere at either end
  EXPECT_NEAR(draw_tube(rng, spec, 1).mass, 1000 * volume, 1e-6);
}

// Three cylinders of one length, each folded back onto the one before.
TEST(DrawTube, GivesUpWhereEveryTubePassesThroughItself) {
  TubeSpec spec;
  spec.segments = {{{1, 2, 0.3}, 3, 3, 0.1, pi, pi}};
  Rng rng(1);
  try {
    draw_tube(rng, spec, 1);
    FAIL() << "a tube was drawn";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("1000"), HasSubstr("passes through itself")));
  }
}

// ---- Tubes through themselves; the diameter is 25 mm

TEST(PassesThroughItself, NotAStraightTubeOfShortCylinders) {
  EXPECT_FALSE(passes_through_itself(
      tube_through({{0, 0, 0}, {0.02, 0, 0}, {0.04, 0, 0}, {0.06, 0, 0}, {0.08, 0, 0}, {0.1, 0, 0}})));
}

// The cylinders beside the short one are 20 mm apart, closest at their joints. At right angles that is where
// the closest points lie on endless lines too, so that rounding puts them to either side of the joint.
TEST(PassesThroughItself, NotABendOfCylindersShorterThanTheDiameter) {
  const Vector3d joint(0.02, 0, 0);
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(0.3, 0.2, 0.1) * Eigen::AngleAxisd(1, Vector3d(2, -1, 2) / 3);
  for (const Vector3d& end : {Vector3d(0.02, 0, -0.1), Vector3d(0.02, 0.1, 0), Vector3d(0.05, 0, 0.1)}) {
    Tube tube = tube_through({{0, 0, 0.1}, {0, 0, 0}, joint, end});
    for (int i = 0; i < 100; ++i) {
      EXPECT_FALSE(passes_through_itself(tube));
      transform(tube, motion);
    }
  }
}

TEST(PassesThroughItself, AHairpinWhoseLegsMeet) {
  const auto hairpin = [](double width_at_ends) {
    return tube_through({{0, 0, 0.1}, {0, 0, 0}, {0.03, 0, 0}, {width_at_ends, 0, 0.1}});
  };
  EXPECT_TRUE(passes_through_itself(hairpin(0.02)));
  EXPECT_FALSE(passes_through_itself(hairpin(0.026))) << "the ends clear each other";
}

TEST(PassesThroughItself, ACurlBackOntoItself) {
  const auto curl = [](double rise) {  // a square whose last side passes the first
    return tube_through(
        {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, rise / 2}, {0.05, 0.1, rise}, {0.05, -0.1, rise}});
  };
  EXPECT_TRUE(passes_through_itself(curl(0.024)));
  EXPECT_FALSE(passes_through_itself(curl(0.026)));
}

TEST(PassesThroughItself, ACurlOfManyShortCylinders) {
  const auto ring = [](double radius) {
    std::vector<Vector3d> points;
    for (int degrees = 0; degrees <= 330; degrees += 15) {
      const double angle = radians(degrees);
      points.push_back(radius * Vector3d(std::cos(angle), std::sin(angle), 0));
    }
    return tube_through(points);
  };
  EXPECT_TRUE(passes_through_itself(ring(0.04))) << "the ends are 21 mm apart";
  EXPECT_FALSE(passes_through_itself(ring(0.06))) << "the ends are 31 mm apart";
}

TEST(PassesThroughItself, WhereTwoJointsComeClosest) {
  const auto tips = [](double gap) {  // > < joined at the back
    return tube_through({{0, 0, 0.1},
                         {0.1, 0, 0},
                         {0, 0, -0.1},
                         {0.1, 0, -0.2},
                         {0.2 + gap, 0, -0.1},
                         {0.1 + gap, 0, 0},
                         {0.2 + gap, 0, 0.1}});
  };
  EXPECT_TRUE(passes_through_itself(tips(0.02)));
  EXPECT_FALSE(passes_through_itself(tips(0.03)));
}

TEST(PassesThroughItself, NotBranchesThatLeaveAJunctionAtAnAcuteAngle) {
  Tube tube = tube_through({{0, 0, 0}, {0.1, 0, 0}, {0.12, 0.002, 0}, {0.2, 0.02, 0}});
  test::add_branch(tube, 1, {{0.12, -0.002, 0}, {0.2, -0.02, 0}});
  EXPECT_FALSE(passes_through_itself(tube));
}

TEST(PassesThroughItself, BranchesThatLeaveAJunctionAndMeetAgain) {
  Tube tube = tube_through({{0, 0, 0}, {0.1, 0, 0}, {0.15, 0.03, 0}, {0.2, 0.01, 0}});
  test::add_branch(tube, 1, {{0.15, -0.03, 0}, {0.2, -0.01, 0}});
  EXPECT_TRUE(passes_through_itself(tube));
}

// Tubes of 3 to 8 cylinders between random points, of which more than half pass through themselves.
Tube any_tangle(Rng& rng) {
  std::vector<Vector3d> points(static_cast<std::size_t>(uniform_integer(rng, 4, 9)));
  for (Vector3d& point : points) {
    for (double& coordinate : point) coordinate = uniform_real(rng, -0.08, 0.08);
  }
  return tube_through(points);
}

RC_GTEST_PROP(PassesThroughItself, WhicheverEndIsFirstAndHoweverItIsTurned, (std::uint64_t seed)) {
  Rng rng(seed);
  const Tube tube = any_tangle(rng);
  const bool passes = passes_through_itself(tube);
  RC_CLASSIFY(passes);

  std::vector<Vector3d> points;
  for (const Node& node : tube.nodes) points.push_back(node.position);
  std::ranges::reverse(points);
  RC_ASSERT(passes_through_itself(tube_through(points)) == passes);

  Tube turned = tube;
  transform(turned, Eigen::Isometry3d(Eigen::AngleAxisd(uniform_real(rng, 0, pi), Vector3d(2, -1, 2) / 3)));
  RC_ASSERT(passes_through_itself(turned) == passes);
}

// ---- The published files

constexpr std::pair<const char*, int> published_files[] = {
    {"A1_1", 1}, {"A2_1", 2}, {"A5_3", 5},    {"A10_2", 10}, {"A20_1", 20},
    {"B1_2", 1}, {"B5_4", 5}, {"B15_13", 15}, {"C1_1", 1},   {"C3_2", 3}};

// As little of the format as these tests need; edges are listed along their segments.
std::vector<Chain> published_chains(const std::filesystem::path& file, int expected_tubes) {
  std::ifstream in(file);
  int tubes = 0;
  in >> tubes;
  EXPECT_EQ(tubes, expected_tubes) << file;
  std::vector<Chain> result;
  for (int i = 0; i < tubes; ++i) {
    int id = 0;
    int nodes = 0;
    int edges = 0;
    in >> id >> nodes >> edges;
    std::map<int, Vector3d> positions;
    for (int k = 0; k < nodes; ++k) {
      int node = 0;
      Vector3d position;
      in >> node >> position.x() >> position.y() >> position.z();
      in.ignore(1000, '\n');
      positions[node] = position;
    }
    for (int k = 0; k < edges; ++k) {
      std::string name;
      int from = 0;
      int to = 0;
      int order = 0;
      in >> name >> from >> to >> order;
      in.ignore(1000, '\n');
      if (order == 1) result.emplace_back();
      const Vector3d along = positions.at(to) - positions.at(from);
      result.back().directions.push_back(along.normalized());
      result.back().lengths.push_back(along.norm());
    }
  }
  EXPECT_TRUE(in) << file;
  return result;
}

class PublishedSet : public testing::TestWithParam<char> {
protected:
  void SetUp() override {
    const std::filesystem::path folder = TANGLEBIN_PUBLISHED;
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no published files in " << folder;
    for (const auto& [name, tubes] : published_files) {
      if (name[0] != GetParam()) continue;
      std::ranges::move(published_chains(folder / (std::string(name) + ".txt"), tubes),
                        std::back_inserter(published));
    }
    const TubeSpec spec = GetParam() == 'C' ? tree_spec() : chain_spec(GetParam() == 'A' ? 30 : 45);
    drawn = drawn_chains(spec, many);
  }

  std::vector<Chain> published;
  std::vector<Chain> drawn;
};

INSTANTIATE_TEST_SUITE_P(Of, PublishedSet, testing::Values('A', 'B', 'C'),
                         [](const auto& set) { return std::string(1, set.param); });

TEST_P(PublishedSet, BendsLikeTheDrawnTubes) {
  const double p = same_distribution_p(bends(published), bends(drawn));
  RecordProperty("p", std::to_string(p));
  EXPECT_GT(p, significance);
}

TEST_P(PublishedSet, BendsTowardsAllSidesLikeTheDrawnTubes) {
  // Tubes came to rest anyhow, so the azimuth about an absolute axis means nothing; that from one bend to the
  // next does.
  const auto twists = [](const std::vector<Chain>& all) {
    std::vector<double> result;
    for (const Chain& chain : all) {
      for (std::size_t i = 2; i < chain.directions.size(); ++i) {
        const Vector3d& axis = chain.directions[i - 1];
        const Vector3d before = chain.directions[i - 2].cross(axis);
        const Vector3d after = axis.cross(chain.directions[i]);
        result.push_back(std::atan2(before.cross(after).dot(axis), before.dot(after)));
      }
    }
    return result;
  };
  EXPECT_GT(same_distribution_p(twists(published), twists(drawn)), significance);
  EXPECT_GT(uniform_p(twists(drawn), -pi, pi), significance);
}

TEST_P(PublishedSet, HasLengthsUniformInWhatRemains) {
  // The files have six digits.
  for (const Chain& chain : published) EXPECT_GT(*std::ranges::min_element(chain.lengths), shortest - 2e-6);
  const double p = uniform_p(shares_of_range(published), 0, 1);
  RecordProperty("p", std::to_string(p));
  EXPECT_GT(p, significance);
}

class PublishedChains : public PublishedSet {};

INSTANTIATE_TEST_SUITE_P(Of, PublishedChains, testing::Values('A', 'B'),
                         [](const auto& set) { return std::string(1, set.param); });

TEST_P(PublishedChains, HasNumbersOfCylindersLikeTheDrawnTubes) {
  EXPECT_GT(equal_counts_p(counts_of_cylinders(published, 5, 10)), significance);
}

TEST_P(PublishedChains, HasLengthsLikeTheDrawnTubesAtEveryPosition) {
  for (const int position : {0, 1, 2, 3, 4, -2, -1}) {
    const double p = same_distribution_p(nth_lengths(published, position), nth_lengths(drawn, position));
    RecordProperty("p" + std::to_string(position), std::to_string(p));
    EXPECT_GT(p, significance) << "cylinder " << position;
  }
  EXPECT_LT(same_distribution_p(nth_lengths(published, 0), nth_lengths(drawn, -1)), significance)
      << "the first cylinders are longer than the last, and the test sees it";
}

}  // namespace
}  // namespace tanglebin
