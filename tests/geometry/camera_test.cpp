#include "tanglebin/geometry/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tests/scan/scene.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::degree;

double field_of_view(double pixels, double focal_length) {
  return 2 * std::atan(pixels / (2 * focal_length));
}

TEST(Camera, FocalLengthOfARightAngleIsHalfTheWidth) {
  EXPECT_NEAR(focal_length_from_hfov(1920, std::numbers::pi / 2), 960, 1e-9);
  EXPECT_NEAR(field_of_view(640, focal_length_from_hfov(640, 1.22)), 1.22, 1e-12);
}

TEST(Camera, PaperPresetIsThatOfThePublishedWorlds) {
  const Camera camera = camera_preset("paper");
  EXPECT_EQ(camera.width, 1920);
  EXPECT_EQ(camera.height, 1200);
  EXPECT_NEAR(field_of_view(1920, camera.fx), 1.22, 1e-12);
  EXPECT_EQ(camera.fx, camera.fy);
  EXPECT_EQ(Vector3d(camera.pose.translation()), Vector3d(0, 0, 2));
}

TEST(Camera, ZividPresetHasTheFieldOfViewOfTheDataSheet) {
  const Camera camera = camera_preset("zivid-one-plus-l");
  EXPECT_EQ(camera.fx, 2730);
  EXPECT_NEAR(field_of_view(1920, camera.fx) / degree, 38.7, 0.1);
  EXPECT_NEAR(field_of_view(1200, camera.fy) / degree, 24.8, 0.1);
}

TEST(Camera, AnUnknownPresetIsNamedTogetherWithTheKnownOnes) {
  try {
    camera_preset("eye");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "found 'eye', expected one of paper, gaussian, zivid-one-plus-l, kinect-v1, phoxi");
  }
}

TEST(Camera, LookingDownTheImageRightIsWorldXAndTheImageDownIsWorldMinusY) {
  const Camera camera = downward_camera(101, 51, 100, Vector3d(1, 2, 3));
  EXPECT_EQ(ray_through(camera, 50, 25).origin, Vector3d(1, 2, 3));
  EXPECT_EQ(ray_through(camera, 50, 25).direction, Vector3d(0, 0, -1));
  EXPECT_EQ(*project(camera, Vector3d(1, 2, 0)), Vector2d(50, 25));
  EXPECT_EQ(*project(camera, Vector3d(1.5, 2, 1)), Vector2d(75, 25));
  EXPECT_EQ(*project(camera, Vector3d(1, 2.5, 1)), Vector2d(50, 0));
}

TEST(Camera, AnImageOfEvenSizeHasItsCentreBetweenPixels) {
  const Camera camera = camera_preset("paper");
  EXPECT_EQ(*project(camera, Vector3d::Zero()), Vector2d(959.5, 599.5));
}

TEST(Camera, WhatIsNotInFrontHasNoProjection) {
  const Camera camera = camera_preset("paper");
  EXPECT_FALSE(project(camera, Vector3d(0, 0, 2)));
  EXPECT_FALSE(project(camera, Vector3d(0.1, 0, 2)));
  EXPECT_FALSE(project(camera, Vector3d(0, 0, 3)));
}

TEST(Camera, PointsOnThePixelsRayProjectOntoThePixel) {
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::AlignedBox3d room(Vector3d::Constant(-2), Vector3d::Constant(2));
    Camera camera =
        test::camera_at(test::random_point(rng, room), test::random_point(rng, room), 640, 480, 1);
    camera.fy *= 1.1;
    camera.cx += 7;
    const Vector2d pixel(uniform_real(rng, -100, 800), uniform_real(rng, -100, 600));
    const Ray ray = ray_through(camera, pixel.x(), pixel.y());
    EXPECT_NEAR(ray.direction.norm(), 1, 1e-15);
    const auto seen = project(camera, ray.origin + uniform_real(rng, 0.1, 5) * ray.direction);
    ASSERT_TRUE(seen);
    EXPECT_LT((*seen - pixel).norm(), 1e-9);
  }
}

TEST(Camera, APixelReachesHalfAPixelAroundItsCentre) {
  // 10 x 8 pixels of 1 mm on the floor; the image's centre is at (4.5, 3.5).
  const Camera camera = downward_camera(10, 8, 1000, {0, 0, 1});
  const auto at = [&](double u, double v) {
    const Eigen::Vector3d point(1e-3 * (u - 4.5), -1e-3 * (v - 3.5), 0);
    const std::optional<PixelPosition> pixel = pixel_of(camera, point);
    return pixel ? std::pair{pixel->column, pixel->row} : std::pair{-1, -1};
  };
  EXPECT_EQ(at(4, 3), std::pair(4, 3));
  EXPECT_EQ(at(4.49, 3.49), std::pair(4, 3));
  EXPECT_EQ(at(4.51, 2.51), std::pair(5, 3));
  EXPECT_EQ(at(-0.49, -0.49), std::pair(0, 0));
  EXPECT_EQ(at(9.49, 7.49), std::pair(9, 7));
  for (const auto& [u, v] : {std::pair{-0.51, 3.0}, {9.51, 3.0}, {4.0, -0.51}, {4.0, 7.51}})
    EXPECT_EQ(at(u, v), std::pair(-1, -1));
  EXPECT_FALSE(pixel_of(camera, {0, 0, 1.5}).has_value());  // behind the camera
}

TEST(Camera, DepthIsAlongItsView) {
  const Camera camera = downward_camera(10, 8, 1000, {0, 0, 1});
  EXPECT_NEAR(depth_of(camera, {0.3, -0.2, 0.25}), 0.75, 1e-12);
  EXPECT_NEAR(depth_of(camera, {0, 0, 1.5}), -0.5, 1e-12);
}

TEST(Camera, ValidationShowsTheNumberInItsShortestForm) {
  Camera camera = camera_preset("paper");
  camera.fx = -1e-9;
  EXPECT_EQ(test::complaint([&] { validate(camera); }),
            "scanner.fx: found -1e-09, expected a finite positive number of pixels");
}

TEST(Camera, ValidationNamesTheFieldThatMakesNoCamera) {
  for (const std::string_view name : scanner_presets()) EXPECT_NO_THROW(validate(camera_preset(name)));
  const auto rejected_field = [](const std::function<void(Camera&)>& spoil) -> std::string {
    Camera camera = camera_preset("paper");
    spoil(camera);
    try {
      validate(camera);
    } catch (const InputError& error) {
      return error.place().field;
    }
    return "none";
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(rejected_field([](Camera& c) { c.width = 0; }), "scanner.width");
  EXPECT_EQ(rejected_field([](Camera& c) { c.height = -1; }), "scanner.height");
  EXPECT_EQ(rejected_field([](Camera& c) { c.fx = 0; }), "scanner.fx");
  EXPECT_EQ(rejected_field([](Camera& c) { c.fy = nan; }), "scanner.fy");
  EXPECT_EQ(rejected_field([](Camera& c) { c.cx = nan; }), "scanner.cx");
  EXPECT_EQ(rejected_field([](Camera& c) { c.cy = nan; }), "scanner.cy");
  EXPECT_EQ(rejected_field([](Camera& c) { c.pose.translation().x() = nan; }), "scanner.pose");
  EXPECT_EQ(rejected_field([](Camera& c) { c.pose.linear() *= 2; }), "scanner.pose");
  EXPECT_EQ(rejected_field([](Camera& c) { c.pose.linear().col(0) *= -1; }), "scanner.pose");
}

}  // namespace
}  // namespace tanglebin
