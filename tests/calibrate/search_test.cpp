#include "tanglebin/calibrate/search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace tanglebin {
namespace {

// The point with the greatest value that a search looks at.
CubePoint best_of(const CubeSearch& search, const std::function<double(const CubePoint&)>& value) {
  CubePoint best = search.start;
  double greatest = value(best);
  search_cube(search, [&](const CubePoint& point) {
    const double here = value(point);
    if (here > greatest) {
      greatest = here;
      best = point;
    }
    return here;
  });
  return best;
}

TEST(CubeSearch, FindsThePeakOfAHill) {
  const auto hill = [](const CubePoint& at) {
    return 1 - std::pow(at[0] - 0.7, 2) - 3 * std::pow(at[1] - 0.2, 2) - std::pow(at[2] - at[0], 2);
  };
  const CubePoint peak = best_of({.start = {0.4, 0.5, 0.5}, .finest = 1e-4}, hill);
  EXPECT_NEAR(peak[0], 0.7, 0.01);
  EXPECT_NEAR(peak[1], 0.2, 0.01);
  EXPECT_NEAR(peak[2], 0.7, 0.01);
}

TEST(CubeSearch, FindsThePeakOfAHillOfSteps) {
  const auto steps = [](const CubePoint& at) {
    return -std::floor(20 * std::abs(at[0] - 0.75)) - std::floor(20 * std::abs(at[1] - 0.25));
  };
  const CubePoint peak = best_of({.start = {0.5, 0.5}}, steps);
  EXPECT_NEAR(peak[0], 0.75, 0.06);
  EXPECT_NEAR(peak[1], 0.25, 0.06);
}

TEST(CubeSearch, StaysInTheCube) {
  const CubePoint peak = best_of({.start = {0.9, 0.1}}, [](const CubePoint& at) {
    for (const double coordinate : at) {
      EXPECT_GE(coordinate, 0);
      EXPECT_LE(coordinate, 1);
    }
    return at[0] - at[1];
  });
  EXPECT_EQ(peak, (CubePoint{1, 0}));
}

TEST(CubeSearch, EndsAfterSoManyValues) {
  int values = 0;
  search_cube({.start = {0.5, 0.5, 0.5}, .finest = 0, .most = 17}, [&](const CubePoint& at) {
    ++values;
    return -std::abs(at[0] - at[1] * at[2]);
  });
  EXPECT_EQ(values, 17);
}

TEST(CubeSearch, EndsWithWhatTheFunctionThrows) {
  const auto fails = [](const CubePoint& /*at*/) -> double { throw std::domain_error("no value"); };
  EXPECT_THROW(search_cube({.start = {0.5}}, fails), std::domain_error);
}

}  // namespace
}  // namespace tanglebin
