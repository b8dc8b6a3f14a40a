#include "tanglebin/model/rim_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "tanglebin/base/constants.hpp"
#include "tests/model/mistakes.hpp"

namespace tanglebin {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// A heap in a bin, as a camera sees it, and where the scene has the bin.
class RimCheck : public testing::Test {
protected:
  std::string said() const {
    const std::optional<Finding> doubt = doubt_of_rim_place(cloud_, support_);
    return doubt ? doubt->message : "";
  }

  void tell(double x, double y, double turn_deg) {
    support_.pose =
        Eigen::Translation3d(x, y, 0) * Eigen::AngleAxisd(turn_deg * degree, Eigen::Vector3d::UnitZ());
  }

  // The heap again, by a camera tilted by so much along the bin's length.
  void scan_from(double tilt_deg) {
    const Eigen::Vector3d back(std::sin(tilt_deg * degree), 0, std::cos(tilt_deg * degree));
    const Camera camera = test::camera_at(1.5 * back, {0, 0, 0.1}, 800, 600, 0.7);
    cloud_ = cloud_from_scan(scan(test::heap(), support_.bin, camera), CloudOf::tubes_and_bin, 4);
  }

  PointCloud cloud_ = test::right_view().cloud;
  Support support_ = test::right_view().scene.support;
};

TEST_F(RimCheck, SaysNothingOfABinInItsPlace) {
  EXPECT_EQ(said(), "");
  for (const double tilt_deg : {10.0, 30.0, 45.0}) {
    scan_from(tilt_deg);
    EXPECT_EQ(said(), "") << tilt_deg << " degrees";
  }
}

TEST_F(RimCheck, SaysWhereABinBesideItsPlaceIsSeen) {
  tell(-0.007, 0, 0);
  EXPECT_THAT(said(), HasSubstr("the bin's rim is seen about 7 mm further in +x: locate it with --locate"));
  tell(0.005, -0.010, 0);
  EXPECT_THAT(said(), HasSubstr("about 5 mm further in -x and 10 mm further in +y:"));
  scan_from(45);
  EXPECT_THAT(said(), ContainsRegex("about [456] mm further in -x and 1?[901] mm further in [+]y:"));
}

TEST_F(RimCheck, SaysByHowMuchABinIsTurned) {
  tell(0, 0, -2);
  EXPECT_THAT(said(), HasSubstr("turned by about 2.0° about z:"));
  tell(0.008, 0, 2);
  EXPECT_THAT(said(), HasSubstr("about 8 mm further in -x and turned by about -2.0° about z:"));
}

TEST_F(RimCheck, SaysByHowMuchABinLeans) {
  const auto tell_lean = [&](double about_x_deg, double about_y_deg) {
    support_.pose = Eigen::AngleAxisd(-about_x_deg * degree, Eigen::Vector3d::UnitX()) *
                    Eigen::AngleAxisd(-about_y_deg * degree, Eigen::Vector3d::UnitY());
  };
  for (const double tilt_deg : {0.0, 30.0, 45.0}) {
    scan_from(tilt_deg);
    tell_lean(2, 0);
    EXPECT_THAT(said(), ContainsRegex("leaning by about (1.9|2.[01])° about x:")) << tilt_deg;
    tell_lean(-2, 0);
    EXPECT_THAT(said(), ContainsRegex("leaning by about -(1.9|2.[01])° about x:")) << tilt_deg;
    tell_lean(0, 1.5);
    EXPECT_THAT(said(), ContainsRegex("leaning by about 1.[456]° about y:")) << tilt_deg;
    tell_lean(0.3, -0.3);
    EXPECT_THAT(said(), Not(HasSubstr("leaning"))) << tilt_deg;
  }
}

TEST_F(RimCheck, DoesNotTakeTubesOverTheRimForALean) {
  const double rim = support_.bin.height;
  for (int i = 0; i < 3'000; ++i) {
    const auto along = static_cast<float>(i % 100) * 0.001F;
    const auto across = static_cast<float>(i / 100) * 0.002F - 0.03F;
    cloud_.points.emplace_back(along, static_cast<float>(support_.bin.width) / 2 + across,
                               static_cast<float>(rim) + 0.02F);
  }
  EXPECT_EQ(said(), "");
}

TEST_F(RimCheck, IsNotTroubledByNoise) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 0.001F);
  for (Eigen::Vector3f& point : cloud_.points) point.z() += noise(random);
  EXPECT_EQ(said(), "");
  tell(-0.007, 0, 0);
  EXPECT_THAT(said(), HasSubstr("about 7 mm further in +x:"));
}

// Walls that bulge outwards by 4 mm in the middle, two of them on one side more than on the other.
TEST_F(RimCheck, LetsABinBeNotQuiteABoxWithinTheMargin) {
  support_.margin = 0.005;
  for (Eigen::Vector3f& point : cloud_.points) {
    const Eigen::Vector3f place = point;
    if (std::abs(place.x()) > 0.27F)
      point.x() += (place.x() > 0 ? 0.004F : -0.001F) * std::cos(place.y() / 0.2F * 1.5F);
    if (std::abs(place.y()) > 0.18F)
      point.y() += (place.y() > 0 ? 0.004F : -0.001F) * std::cos(place.x() / 0.3F * 1.5F);
  }
  EXPECT_EQ(said(), "");
}

TEST_F(RimCheck, TellsAnotherSizeFromAnotherPlace) {
  support_.bin.length += 0.03;
  EXPECT_THAT(said(), HasSubstr("the bin may have another size"));
}

TEST_F(RimCheck, SaysNothingWithoutARim) {
  cloud_.points.clear();
  EXPECT_EQ(said(), "");
}

}  // namespace
}  // namespace tanglebin
