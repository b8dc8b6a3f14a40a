#include "tanglebin/pictures/view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;

std::vector<Vector3d> random_points() {
  std::vector<Vector3d> points;
  const int count = *rc::gen::inRange(1, 20);
  for (int i = 0; i < count; ++i) {
    const auto coordinate = [] { return *rc::gen::inRange(-1000, 1000) / 100.0; };
    const double x = coordinate();
    const double y = coordinate();
    points.emplace_back(x, y, coordinate());
  }
  return points;
}

RC_GTEST_PROP(View, EveryPointLiesInTheImage, ()) {
  const View view{.azimuth = *rc::gen::inRange(-180, 181) * degree,
                  .elevation = *rc::gen::inRange(-90, 91) * degree,
                  .width = *rc::gen::inRange(1, 2000),
                  .height = *rc::gen::inRange(1, 2000)};
  const auto points = random_points();
  const Camera camera = camera_for(view, 2, points, "cloud.ply");
  validate(camera);
  for (const Vector3d& point : points) {
    const auto pixel = project(camera, point);
    RC_ASSERT(pixel.has_value());
    RC_ASSERT(pixel->x() >= -0.5 && pixel->x() <= camera.width - 0.5);
    RC_ASSERT(pixel->y() >= -0.5 && pixel->y() <= camera.height - 0.5);
  }
}

TEST(View, TheSceneFillsTheImage) {
  const std::vector<Vector3d> points = {Vector3d(5, 5, 1), Vector3d(7, 5, 1), Vector3d(5, 6, 1.5)};
  const Camera camera = camera_for({.width = 400, .height = 300}, 1, points, "");
  Eigen::AlignedBox2d box;
  for (const Vector3d& point : points) box.extend(*project(camera, point));
  const double filled = std::max(box.sizes().x() / 400, box.sizes().y() / 300);
  EXPECT_GT(filled, 0.85);
  EXPECT_NEAR(box.center().x(), 199.5, 20);
  EXPECT_NEAR(box.center().y(), 149.5, 20);
}

TEST(View, FromAboveTheImageIsAsTheDownwardCameraHasIt) {
  const View view{.azimuth = -90 * degree, .elevation = 90 * degree};
  const Camera camera = camera_for(view, 1, {Vector3d(-1, -1, 0), Vector3d(1, 1, 0)}, "");
  const Camera downward = downward_camera(1200, 900, 1800, Vector3d(0, 0, 1));
  EXPECT_TRUE(camera.pose.linear().isApprox(downward.pose.linear(), 1e-12));
}

TEST(View, TheViewerStandsWhereTheAnglesSay) {
  const View view{.azimuth = 90 * degree, .elevation = 0};
  const Camera camera = camera_for(view, 1, {Vector3d(-1, 0, 0), Vector3d(1, 0, 0)}, "");
  EXPECT_GT(camera.pose.translation().y(), 1);
  EXPECT_NEAR(camera.pose.translation().x(), 0, 1e-12);
  EXPECT_LT(project(camera, Vector3d(0, 0, 0.1))->y(), project(camera, Vector3d::Zero())->y()) << "z is up";
}

TEST(View, APointAloneHasAView) {
  const Camera camera = camera_for({}, 1, {Vector3d(1e6, -1e6, 3)}, "");
  EXPECT_TRUE((*project(camera, Vector3d(1e6, -1e6, 3)) - Eigen::Vector2d(599.5, 449.5)).norm() < 1);
}

TEST(View, CoordinatesThatMustBeWrongAreNamed) {
  try {
    camera_for({}, 1, {Vector3d::Zero(), Vector3d(0, 1e30, 0)}, "odd.ply");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "odd.ply: x y z: found 1e+30 m, expected coordinates within 1e+07 m");
  }
}

TEST(View, AViewThatIsNoneIsRefused) {
  const auto field_of = [](const View& view) -> std::string {
    try {
      validate(view);
    } catch (const InputError& error) {
      return error.place().field;
    }
    return "no error";
  };
  EXPECT_EQ(field_of({}), "no error");
  EXPECT_EQ(field_of({.width = 0}), "width");
  EXPECT_EQ(field_of({.width = largest_picture + 1}), "width");
  EXPECT_EQ(field_of({.height = -5}), "height");
  EXPECT_EQ(field_of({.elevation = 91 * degree}), "elevation");
  EXPECT_EQ(field_of({.elevation = std::numeric_limits<double>::quiet_NaN()}), "elevation");
  EXPECT_EQ(field_of({.azimuth = std::numeric_limits<double>::infinity()}), "azimuth");
}

}  // namespace
}  // namespace tanglebin
