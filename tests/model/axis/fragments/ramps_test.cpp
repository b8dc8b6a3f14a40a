#include "tanglebin/model/axis/fragments/ramps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "tanglebin/base/constants.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3f;

using test::radius;
constexpr int size = 60;  // pixels, of the images below
constexpr double focal_length = 1000;

// In the camera's frame; a pixel is 1 mm wide at 1 m.
Camera camera() {
  Camera result{.width = size, .height = size, .fx = focal_length, .fy = focal_length};
  result.cx = result.cy = (size - 1) / 2.0;
  return result;
}

// The points, row by row, of an image whose depth (m) follows from the column; NaN for none.
std::vector<Vector3f> image(const std::function<double(int)>& depth_at) {
  std::vector<Vector3f> points;
  for (int v = 0; v < size; ++v) {
    for (int u = 0; u < size; ++u) {
      const double depth = depth_at(u);
      points.push_back(
          (Eigen::Vector3d((u - camera().cx) / focal_length, (v - camera().cy) / focal_length, 1) * depth)
              .cast<float>());
    }
  }
  return points;
}

Ramps ramps_of(const std::function<double(int)>& depth_at, const RampSettings& settings = {}) {
  return find_ramps(image(depth_at), camera(), radius, radius, settings);
}

// The columns with points on ramps, in the image's first row. All rows are alike.
std::vector<int> columns(const Ramps& ramps) {
  std::vector<int> result;
  for (int u = 0; u < size; ++u) {
    if (ramps.points[static_cast<std::size_t>(u)]) result.push_back(u);
  }
  return result;
}

constexpr double near = 1.0;
constexpr double far = 1.1;

TEST(Ramps, AreBetweenTwoSurfaces) {
  const RampSettings only_between{.beside = 0};
  const auto down = [](int u) { return u < 30 ? near : u == 30 ? 1.03 : u == 31 ? 1.07 : far; };
  EXPECT_THAT(columns(ramps_of(down, only_between)), testing::ElementsAre(30, 31));
  EXPECT_DOUBLE_EQ(ramps_of(down).blended, 1);
  const auto up = [&](int u) { return down(size - 1 - u); };
  EXPECT_THAT(columns(ramps_of(up, only_between)), testing::ElementsAre(28, 29));
  EXPECT_DOUBLE_EQ(ramps_of(up).blended, 1);
}

// As a line scanner sees it, along its line.
TEST(Ramps, AreInAnImageOfOneColumnToo) {
  Camera line = camera();
  line.width = 1;
  line.cx = 0;
  std::vector<Vector3f> points;
  for (int v = 0; v < size; ++v) {
    const double depth = v < 30 ? near : v == 30 ? 1.03 : v == 31 ? 1.07 : far;
    points.push_back((Eigen::Vector3d(0, (v - line.cy) / focal_length, 1) * depth).cast<float>());
  }
  const Ramps ramps = find_ramps(points, line, radius, radius, {.beside = 0});
  EXPECT_EQ(std::ranges::count(ramps.points, true), 2);
  EXPECT_TRUE(ramps.points[30] && ramps.points[31]);
  EXPECT_DOUBLE_EQ(ramps.blended, 1);
}

// The points at the ends of ramps, of which the points in the image's first row have more.
std::vector<std::pair<std::size_t, std::size_t>> ends_in_first_row(const Ramps& ramps) {
  std::vector<std::pair<std::size_t, std::size_t>> result;
  for (const auto& [point, end] : ramps.between) {
    if (point < size) result.emplace_back(point, end);
  }
  return result;
}

TEST(Ramps, HaveMoreOfTheSurfaceThatIsNearerInDepth) {
  using testing::ElementsAre;
  using testing::Pair;
  const auto down = [](int u) { return u < 30 ? near : u == 30 ? 1.03 : u == 31 ? 1.06 : far; };
  const RampSettings only_between{.beside = 0};
  EXPECT_THAT(ends_in_first_row(ramps_of(down, only_between)), ElementsAre(Pair(30, 29), Pair(31, 32)));
  const auto up = [&](int u) { return down(size - 1 - u); };
  EXPECT_THAT(ends_in_first_row(ramps_of(up, only_between)), ElementsAre(Pair(28, 27), Pair(29, 30)));
  EXPECT_THAT(ends_in_first_row(ramps_of(down)),
              ElementsAre(Pair(29, 28), Pair(30, 28), Pair(31, 33), Pair(32, 33)));
}

TEST(Ramps, EndWhereThereIsASurfaceBesideThem) {
  using testing::Pair;
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const auto depth = [&](int u) {
    return u < 29 ? nothing : u == 29 ? near : u == 30 ? 1.03 : u == 31 ? 1.06 : far;
  };
  EXPECT_THAT(ends_in_first_row(ramps_of(depth)),
              testing::ElementsAre(Pair(30, 29), Pair(31, 33), Pair(32, 33)));
}

TEST(Ramps, BendWhatIsBesideThem) {
  const auto depth = [](int u) { return u < 30 ? near : u == 30 ? 1.03 : u == 31 ? 1.07 : far; };
  EXPECT_THAT(columns(ramps_of(depth)), testing::ElementsAre(29, 30, 31, 32));
  EXPECT_THAT(columns(ramps_of(depth, {.beside = 1})), testing::ElementsAre(28, 29, 30, 31, 32, 33));
}

TEST(Ramps, AreNotAtASharpEdge) {
  const Ramps ramps = ramps_of([](int u) { return u < 30 ? near : far; });
  EXPECT_THAT(columns(ramps), testing::IsEmpty());
  EXPECT_EQ(ramps.blended, 0);
}

TEST(Ramps, AreNotTheFlankOfATube) {
  // A tube along y whose axis is at the far plane's depth.
  const auto depth = [](int u) {
    const double x = (u - camera().cx) / focal_length;
    return std::abs(x) < radius ? near - std::sqrt(radius * radius - x * x) : near;
  };
  EXPECT_THAT(columns(ramps_of(depth)), testing::IsEmpty());
}

TEST(Ramps, AreNotASteepSurface) {
  const auto depth = [](int u) { return near + 0.003 * std::clamp(u - 20, 0, 20); };
  EXPECT_THAT(columns(ramps_of(depth)), testing::IsEmpty());
}

TEST(Ramps, MayLeadNowhere) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const auto depth = [&](int u) { return u < 30 ? near : u == 30 ? 1.01 : u == 31 ? 1.02 : nothing; };
  const Ramps ramps = ramps_of(depth, {.beside = 0});
  EXPECT_THAT(columns(ramps), testing::ElementsAre(30, 31));
  EXPECT_THAT(ends_in_first_row(ramps), testing::IsEmpty());
}

TEST(Ramps, AreNotInACloudOfFewPixels) {
  const auto depth = [](int u) { return u < 30 ? near : u == 30 ? 1.05 : far; };
  std::vector<Vector3f> points = image(depth);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_kept = i % size % 2 == 0 && i / size % 2 == 0;
    if (!is_kept) points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  const Ramps ramps = find_ramps(points, camera(), radius, radius, {});
  EXPECT_EQ(ramps.blended, 0);
  EXPECT_EQ(std::ranges::count(ramps.points, true), 0);
  EXPECT_TRUE(find_ramps({}, camera(), radius, radius, {}).points.empty());
}

TEST(Ramps, AreWhatAScannerThatMixesMakes) {
  const std::vector<Tube> tubes = {test::straight_tube(1, 0),
                                   test::chain(2, radius, {{0, -0.15, 0.0375}, {0, 0.15, 0.0375}})};
  const KnownScene scene = test::paper_scene();
  Sensor mixing;
  mixing.edges = Edges::mix;
  const auto ramps_by = [&](const Sensor& sensor) {
    const PointCloud cloud =
        cloud_from_scan(scan(tubes, scene.support.bin, scene.camera, sensor, 1), CloudOf::tubes_and_bin, 2);
    return find_ramps(cloud.points, scene.camera, radius, radius, {});
  };
  EXPECT_LT(ramps_by({}).blended, 0.05);
  EXPECT_GT(ramps_by(mixing).blended, 0.2);
}

}  // namespace
}  // namespace tanglebin
