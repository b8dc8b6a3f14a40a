#include "tanglebin/geometry/bin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

double volume(const Bin& bin) {
  double sum = 0;
  for (const AlignedBox3d& box : boxes(bin)) sum += box.volume();
  return sum;
}

TEST(Bin, PresetsHaveTheSizesOfThePaperAndOfThePublishedWorlds) {
  const Bin paper = bin_preset("paper");
  EXPECT_EQ(Vector3d(paper.length, paper.width, paper.height), Vector3d(0.55, 0.37, 0.20));
  const Bin published = bin_preset("published");
  EXPECT_EQ(Vector3d(published.length, published.width, published.height), Vector3d(0.80, 0.60, 0.20));
  EXPECT_EQ(published.wall, 0.02);
}

TEST(Bin, AnUnknownPresetIsNamedTogetherWithTheKnownOnes) {
  try {
    bin_preset("bucket");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "found 'bucket', expected one of paper, published");
  }
}

TEST(Bin, TheFloorIsUnderTheOriginAndTheWallsStandWhereTheyAreNamed) {
  const auto [floor, left, right, front, back] = boxes(Bin{});
  EXPECT_EQ(floor.max().z(), 0);
  EXPECT_TRUE(floor.contains(Vector3d::Zero()));
  EXPECT_TRUE(left.contains(Vector3d(-0.28, 0, 0.1)));
  EXPECT_TRUE(right.contains(Vector3d(0.28, 0, 0.1)));
  EXPECT_TRUE(front.contains(Vector3d(0, -0.19, 0.1)));
  EXPECT_TRUE(back.contains(Vector3d(0, 0.19, 0.1)));
}

TEST(Bin, BoxesFillTheShellOnceAndLeaveTheInsideFree) {
  const Bin bin = bin_preset("published");
  const AlignedBox3d inside(Vector3d(-bin.length / 2, -bin.width / 2, 0),
                            Vector3d(bin.length / 2, bin.width / 2, bin.height));
  const Vector3d wall(bin.wall, bin.wall, 0);
  const AlignedBox3d outside(inside.min() - wall - bin.wall * Vector3d::UnitZ(), inside.max() + wall);

  AlignedBox3d hull;
  for (const AlignedBox3d& box : boxes(bin)) {
    hull.extend(box);
    EXPECT_EQ(box.intersection(inside).volume(), 0);
  }
  EXPECT_TRUE(hull.isApprox(outside));
  // Free of the inside, within the outside and of the shell's volume: so they do not overlap.
  EXPECT_NEAR(volume(bin), outside.volume() - inside.volume(), 1e-12);
}

TEST(Bin, TellsWhatIsOverItsFloorAtAnyHeightAndHowFarFromTheWalls) {
  const Bin bin{.length = 0.4, .width = 0.2};
  for (const double z : {-1.0, 0.0, 0.5}) {
    EXPECT_TRUE(is_over_floor(bin, {0.19, -0.09, z}));
    EXPECT_FALSE(is_over_floor(bin, {0.21, 0, z}));
    EXPECT_FALSE(is_over_floor(bin, {0, -0.11, z}));
    EXPECT_FALSE(is_over_floor(bin, {0.19, 0, z}, 0.02));
    EXPECT_TRUE(is_over_floor(bin, {0.21, -0.11, z}, -0.02));
  }
}

TEST(Bin, ValidationNamesTheFieldThatIsNotAPositiveNumber) {
  EXPECT_NO_THROW(validate(Bin{}));
  const auto rejected_field = [](double Bin::*member, double value) -> std::string {
    Bin bin;
    bin.*member = value;
    try {
      validate(bin);
    } catch (const InputError& error) {
      return error.place().field;
    }
    return "none";
  };
  EXPECT_EQ(rejected_field(&Bin::length, 0), "bin.length");
  EXPECT_EQ(rejected_field(&Bin::width, -0.1), "bin.width");
  EXPECT_EQ(rejected_field(&Bin::height, std::numeric_limits<double>::infinity()), "bin.height");
  EXPECT_EQ(rejected_field(&Bin::wall, std::numeric_limits<double>::quiet_NaN()), "bin.wall");
  EXPECT_EQ(rejected_field(&Bin::friction, -1), "bin.friction");
}

TEST(Bin, ValidationTakesLargeSizesForMillimetres) {
  const auto complaint = [](const Bin& bin) { return test::complaint([&] { validate(bin); }); };
  EXPECT_EQ(complaint({.height = 300}), "bin.height: found 300 m, expected 0 to 10 m; for 300 mm write 0.3");
  EXPECT_EQ(complaint({.length = 550}),
            "bin.length: found 550 m, expected 0.02 to 10 m; for 550 mm write 0.55");
  EXPECT_EQ(complaint({.width = 0.001}), "bin.width: found 0.001 m, expected 0.02 to 10 m");
  EXPECT_EQ(complaint({.wall = 20}), "bin.wall: found 20 m, expected 0 to 10 m; for 20 mm write 0.02");
  EXPECT_EQ(complaint({.length = 10, .width = 0.02, .height = 0.001, .wall = 1e-4, .friction = 1000}),
            "none");
}

}  // namespace
}  // namespace tanglebin
