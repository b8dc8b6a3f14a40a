#include "tanglebin/base/random.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/statistics.hpp"

namespace tanglebin {
namespace {

using test::equal_counts_p;
using test::significance;
using test::uniform_p;

// Computed apart from this program, from the definitions of FNV-1a and SplitMix64. A dataset of a published
// recipe can be made again only as long as these hold.
TEST(AttemptSeed, KeepsItsKnownValues) {
  EXPECT_EQ(attempt_seed(0, "", 0, 0, 0), 0x0c54c06d8b8a43a3U);
  EXPECT_EQ(attempt_seed(0, "A", 1, 1, 1), 0xe9d2ed0bb9cf8deaU);
  EXPECT_EQ(attempt_seed(1, "A", 10, 2, 1), 0x3530aadc2ccbff1fU);
  EXPECT_EQ(attempt_seed(18446744073709551615U, "set-c", 20, 20, 100), 0x410d658474824b2dU);
}

RC_GTEST_PROP(AttemptSeed, ChangesWithEveryArgument,
              (std::uint64_t seed, const std::string& set, int tubes, int case_id, int attempt)) {
  const auto base = attempt_seed(seed, set, tubes, case_id, attempt);
  RC_ASSERT(base == attempt_seed(seed, set, tubes, case_id, attempt));
  const auto other = *rc::gen::nonZero<int>();
  RC_ASSERT(base != attempt_seed(seed + static_cast<std::uint64_t>(other), set, tubes, case_id, attempt));
  RC_ASSERT(base != attempt_seed(seed, set + "A", tubes, case_id, attempt));
  RC_ASSERT(base != attempt_seed(seed, set, tubes ^ other, case_id, attempt));
  RC_ASSERT(base != attempt_seed(seed, set, tubes, case_id ^ other, attempt));
  RC_ASSERT(base != attempt_seed(seed, set, tubes, case_id, attempt ^ other));
}

TEST(AttemptSeed, DiffersBetweenAllAttemptsOfADataset) {
  std::set<std::uint64_t> seeds;
  std::size_t attempts = 0;
  for (const char* set : {"A", "B", "C"}) {
    for (int tubes = 1; tubes <= 20; ++tubes) {
      for (int case_id = 1; case_id <= 20; ++case_id) {
        for (int attempt = 1; attempt <= 20; ++attempt, ++attempts) {
          seeds.insert(attempt_seed(0, set, tubes, case_id, attempt));
        }
      }
    }
  }
  EXPECT_EQ(seeds.size(), attempts);
}

TEST(AttemptSeed, IsSpreadOverAllItsBits) {
  constexpr int cases = 10000;
  std::vector<int> ones(64);
  for (int case_id = 0; case_id < cases; ++case_id) {
    const std::uint64_t seed = attempt_seed(0, "A", 10, case_id, 1);
    for (std::size_t bit = 0; bit < ones.size(); ++bit) ones[bit] += static_cast<int>((seed >> bit) & 1U);
  }
  for (const int count : ones) EXPECT_NEAR(count, cases / 2, 300);  // six standard deviations
}

// The C++ standard gives the 10000th value of a default mt19937_64 ([rand.predef]).
TEST(Rng, IsTheStandardMersenneTwister) {
  Rng rng;
  rng.discard(9999);
  EXPECT_EQ(rng(), 9981545732273789042U);
}

TEST(UniformInteger, GivesEveryNumberOfItsRangeEquallyOften) {
  for (const auto& [low, high] : {std::pair{5, 10}, {-3, 3}, {0, 99}, {1, 64}}) {
    Rng rng(1);
    std::vector<std::size_t> counts(static_cast<std::size_t>(high - low + 1));
    for (int i = 0; i < 100000; ++i)
      ++counts.at(static_cast<std::size_t>(uniform_integer(rng, low, high) - low));
    EXPECT_GT(equal_counts_p(counts), significance) << low << " to " << high;
  }
}

RC_GTEST_PROP(UniformInteger, StaysWithinItsBounds, (int a, int b, std::uint64_t seed)) {
  Rng rng(seed);
  const auto [low, high] = std::minmax(a, b);
  for (int i = 0; i < 10; ++i) {
    const int drawn = uniform_integer(rng, low, high);
    RC_ASSERT(drawn >= low);
    RC_ASSERT(drawn <= high);
  }
}

TEST(UniformReal, IsUniformOverItsRange) {
  Rng rng(1);
  std::vector<double> sample;
  for (int i = 0; i < 100000; ++i) sample.push_back(uniform_real(rng, -0.02, 0.4));
  EXPECT_GT(uniform_p(sample, -0.02, 0.4), significance);
  EXPECT_LT(uniform_p(sample, -0.02, 0.41), significance) << "the test sees a range that is 2 % off";
}

TEST(UniformReal, ExcludesItsUpperBound) {
  Rng rng(1);
  const double next = std::nextafter(1.0, 2.0);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(uniform_real(rng, 1.0, next), 1.0);
}

TEST(UniformReal, GivesTheOneValueOfAnEmptyRange) {
  Rng rng(1);
  EXPECT_EQ(uniform_real(rng, 0.02, 0.02), 0.02);
}

// The same on every platform and standard library: values of Boost.Random, written down once.
TEST(Draws, KeepTheirKnownValues) {
  Rng rng(42);
  EXPECT_DOUBLE_EQ(uniform_real(rng, 0, 1), 0.75515553295453897);
  EXPECT_DOUBLE_EQ(uniform_real(rng, 2, 4), 3.2780627877093949);
  EXPECT_EQ(uniform_integer(rng, 5, 10), 9);
  EXPECT_EQ(uniform_integer(rng, 1, 1000000), 136273);
}

}  // namespace
}  // namespace tanglebin
