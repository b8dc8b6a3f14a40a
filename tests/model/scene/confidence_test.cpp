#include "tanglebin/model/scene/confidence.hpp"

#include <gtest/gtest.h>

namespace tanglebin {
namespace {

/// A whole hose with a radius of 10 mm and a length of half a metre.
class Confidence : public testing::Test {
protected:
  Confidence() {
    evidence_.length = evidence_.visible_length = 0.5;
    known_.kinds = {{.radius = 0.01, .length_min = 0.5}};
  }

  double with_residual(double residual) {
    evidence_.residual = residual;
    return confidence(features_of(evidence_, known_));
  }

  TubeEvidence evidence_;
  KnownScene known_;
};

TEST_F(Confidence, IsHighForAWholeTubeWithoutJoins) {
  EXPECT_GT(with_residual(0.0002), 0.98);
}

TEST_F(Confidence, FallsWithTheResidual) {
  EXPECT_LT(with_residual(0.001), with_residual(0.0002));
  known_.support.shape = Support::Shape::nothing;
  EXPECT_LT(with_residual(0.001), with_residual(0.0002));
}

// What looks like a tube, but only roughly, may be a part of the floor that nobody told of.
TEST_F(Confidence, FallsWithTheResidualMostWhereNoSupportIsKnown) {
  const double in_a_bin = with_residual(0.002);
  known_.support.shape = Support::Shape::nothing;
  EXPECT_LT(with_residual(0.002), in_a_bin);
  EXPECT_LT(with_residual(0.004), 0.5);
}

// Of a cloud that was modelled several times.
TEST_F(Confidence, FallsWithTheShareOfOtherModelsThatDoNotHaveTheTube) {
  const double in_all = with_residual(0.0002);
  evidence_.disagreement = 0.5;
  const double in_half = with_residual(0.0002);
  evidence_.disagreement = 1;
  EXPECT_LT(in_half, in_all);
  EXPECT_LT(with_residual(0.0002), in_half);
}

TEST_F(Confidence, FallsWithWhatALengthLacksOrHasTooMuch) {
  const double whole = with_residual(0.0002);
  evidence_.length = evidence_.visible_length = 0.3;
  EXPECT_LT(with_residual(0.0002), whole);
  evidence_.length = evidence_.visible_length = 0.7;
  EXPECT_LT(with_residual(0.0002), whole);
}

}  // namespace
}  // namespace tanglebin
