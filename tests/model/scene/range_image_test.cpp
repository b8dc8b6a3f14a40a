#include "tanglebin/model/scene/range_image.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::cloud_of;
using test::small_camera;

TEST(RangeImage, HidesAWayUnderWhatIsNearerThanItsFartherEnd) {
  const RangeImage image(cloud_of({{0, 0, 0.5F}}).points, small_camera());
  EXPECT_TRUE(image.hides({-0.03, 0, 0.1}, {0.03, 0, 0.1}, 2));
  EXPECT_TRUE(image.hides({-0.03, 0, 0.7}, {0.03, 0, 0.4}, 2)) << "nearer than one of them is enough";
  EXPECT_FALSE(image.hides({-0.03, 0, 0.7}, {0.03, 0, 0.7}, 2)) << "both ends are above it";
}

TEST(RangeImage, LooksOnlyAroundTheMiddle) {
  const RangeImage image(cloud_of({{0, 0, 0.5F}}).points, small_camera());
  // The middle's projection is 5 pixels from that of the point.
  EXPECT_FALSE(image.hides({0.01, -0.02, 0}, {0.01, 0.02, 0}, 4));
  EXPECT_TRUE(image.hides({0.01, -0.02, 0}, {0.01, 0.02, 0}, 5));
}

TEST(RangeImage, KeepsTheNearestOfSeveralPointsInAPixel) {
  const RangeImage image(cloud_of({{0, 0, 0.1F}, {0, 0, 0.5F}, {0, 0, 0.2F}}).points, small_camera());
  EXPECT_TRUE(image.hides({-0.01, 0, 0.4}, {0.01, 0, 0.4}, 1));
}

TEST(RangeImage, OfNothingHidesNothing) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const RangeImage image(cloud_of({{nan, nan, nan}, {0, 0, 5}, {90, 0, 0}}).points, small_camera());
  EXPECT_FALSE(image.hides({-0.01, 0, 0.1}, {0.01, 0, 0.1}, 50));
  EXPECT_FALSE(image.hides({-0.01, 0, 3}, {0.01, 0, 0.1}, 50)) << "an end behind the camera";
  EXPECT_FALSE(image.hides({-9, 0, 0.1}, {-9, 0, 0.2}, 3)) << "a middle outside of the image";
}

TEST(RangeImage, AnswersTheSameWithoutTheRowsThatMeasuredNothing) {
  const RangeImage whole(cloud_of({{0, 0.05F, 0.5F}, {0.02F, -0.1F, 0.3F}}).points, small_camera());
  RangeImage trimmed = whole;
  trimmed.keep_measured_rows();
  for (double x = -0.3; x < 0.3; x += 0.01) {
    for (double y = -0.3; y < 0.3; y += 0.01) {
      for (const double z : {0.1, 0.4}) {
        const Vector3d place(x, y, z);
        EXPECT_EQ(trimmed.hides(place, place, 3), whole.hides(place, place, 3)) << place.transpose();
        EXPECT_EQ(trimmed.shows_empty(place, 0.0125), whole.shows_empty(place, 0.0125)) << place.transpose();
      }
    }
  }
  RangeImage nothing({}, small_camera());
  nothing.keep_measured_rows();
  EXPECT_FALSE(nothing.hides({0, 0, 0.1}, {0, 0, 0.1}, 50));
}

TEST(RangeImage, OfAPlaceBesideTheCameraShowsNothing) {
  const Camera camera = small_camera();
  const RangeImage image(cloud_of({{0, 0, 0.5F}}).points, camera);
  // Its projection is some 1e20 pixels away.
  const Vector3d beside = camera.pose * Vector3d(1, 0, 1e-18);
  EXPECT_FALSE(image.shows_empty(beside, 0.0125));
  EXPECT_FALSE(image.hides(beside, beside, 2));
}

TEST(RangeImage, ShowsThatNoTubeIsInWhatIsSolid) {
  const std::vector<Eigen::AlignedBox3d> wall = {{Vector3d(0.1, -1, 0), Vector3d(0.12, 1, 0.2)}};
  const RangeImage image({}, small_camera(), wall);
  EXPECT_TRUE(image.shows_empty({0.11, 0, 0.1}, 0.0125));
  EXPECT_TRUE(image.shows_empty({0.095, 0, 0.1}, 0.0125)) << "nearer than half a radius";
  EXPECT_FALSE(image.shows_empty({0.0875, 0, 0.1}, 0.0125)) << "touches it";
}

}  // namespace
}  // namespace tanglebin
