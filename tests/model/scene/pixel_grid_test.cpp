#include "tanglebin/model/scene/pixel_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tanglebin/base/random.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using test::small_camera;
using testing::IsEmpty;

std::vector<Eigen::Vector3f> points_in(const PixelGrid& grid, const PixelGrid::Run& run) {
  std::vector<Eigen::Vector3f> found;
  for (std::size_t i = 0; i < run.size; ++i) found.push_back(grid.point(run.first + i));
  return found;
}

TEST(PixelGrid, FindsPointsByTheirPixels) {
  const std::vector<Eigen::Vector3f> points = {{0, 0, 0}, {0.002F, 0, 0}, {0, -0.002F, 0}, {0, 0, 0.1F}};
  const PixelGrid grid(points, small_camera());
  const auto row_around = [&](const PixelPosition& middle, int reach, int row) {
    return points_in(grid, grid.window(middle, reach).row(row));
  };
  EXPECT_THAT(row_around({50, 50}, 0, 50), testing::ElementsAre(points[0], points[3]));
  EXPECT_THAT(row_around({50, 50}, 50, 50), testing::ElementsAre(points[0], points[3], points[1]));
  EXPECT_THAT(row_around({500, 51}, 510, 51), testing::ElementsAre(points[2]));
  EXPECT_THAT(row_around({50, 50}, 0, 51), IsEmpty());
  EXPECT_THAT(row_around({50, 50}, 50, 52), IsEmpty());
  EXPECT_THAT(row_around({50, 50}, 50, -1), IsEmpty());
  EXPECT_EQ(grid.window({500, 500}, 10).rows(), 0);
}

TEST(PixelGrid, LeavesOutWhatTheCameraCannotSee) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const PixelGrid grid({{1, 0, 0}, {0, 0, 3}, {nan, nan, nan}}, small_camera());
  EXPECT_EQ(grid.size(), 0U);
  EXPECT_EQ(grid.window({50, 50}, 50).rows(), 0);
}

TEST(PixelGrid, KnowsHowWideALengthAppears) {
  const PixelGrid grid({}, small_camera());
  EXPECT_NEAR(grid.pixels_across(0.01, {0, 0, 0}), 5, 1e-9);
  EXPECT_NEAR(grid.pixels_across(0.01, {0.03F, 0, 1}), 10, 1e-6);
  const Eigen::Vector3f at_the_camera(0, 0, std::nextafter(2.0F, 0.0F));
  EXPECT_LE(grid.pixels_across(1, at_the_camera), 1e6);
}

TEST(PixelGrid, HoldsEveryPointOnceWhereItProjects) {
  Rng rng(1);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 1000; ++i) {
    const auto coordinate = [&] { return static_cast<float>(uniform_real(rng, -0.08, 0.08)); };
    points.emplace_back(coordinate(), coordinate(), coordinate());
  }
  const Camera camera = small_camera();
  const PixelGrid grid(points, camera);
  ASSERT_EQ(grid.size(), points.size());
  std::vector<bool> seen(points.size());
  for (std::size_t item = 0; item < grid.size(); ++item) {
    const Eigen::Vector3f point = grid.point(item);
    const std::uint32_t index = grid.indices()[item];
    EXPECT_FALSE(seen[index]);
    seen[index] = true;
    EXPECT_EQ(point, points[index]);
    const Eigen::Vector2d image = *project(camera, point.cast<double>());
    EXPECT_NEAR(image.x(), grid.pixels()[item].column, 0.5);
    EXPECT_NEAR(image.y(), grid.pixels()[item].row, 0.5);
  }
}

}  // namespace
}  // namespace tanglebin
