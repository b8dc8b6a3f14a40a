#include "tanglebin/model/scene/label.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tanglebin/base/random.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using test::cloud_of;
using testing::Each;
using testing::ElementsAre;

TEST(LabelByNearest, GivesAPointToTheNearestSurface) {
  const std::vector<Tube> tubes = {test::straight_tube(1, 0), test::straight_tube(2, 0.03)};
  // Their surfaces are 5 mm apart, from y = 12.5 to 17.5 mm.
  const PointCloud cloud = cloud_of(
      {{0, 0.013F, 0.0125F}, {0, 0.017F, 0.0125F}, {0, 0, 0.026F}, {0, 0, 0.04F}, {0.3F, 0, 0.0125F}});
  const LabelSettings near{.distance_max = 0.32};
  EXPECT_THAT(label_by_nearest(cloud, {0, 1, 2, 3, 4}, tubes, near),
              ElementsAre(1, 2, 1, null_label, null_label));
  EXPECT_THAT(label_by_nearest(cloud, {3, 1}, tubes, near), ElementsAre(null_label, 2));
}

TEST(LabelByNearest, AgreesWithALoopOverAllPairs) {
  Rng rng(11);
  const Bin bin = bin_preset("paper");
  const std::vector<Tube> tubes = test::random_pile(rng, 8, bin);
  const PointCloud cloud = test::scanned(tubes);
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < cloud.points.size(); i += 7) points.push_back(i);
  const LabelSettings settings;
  const std::vector<std::int32_t> labels = label_by_nearest(cloud, points, tubes, settings);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d point = cloud.points[points[i]].cast<double>();
    double nearest = settings.distance_max * test::radius;
    std::int32_t label = null_label;
    for (const Tube& tube : tubes) {
      for (const Capsule& capsule : capsules(tube)) {
        const double distance =
            std::abs(closest_points(point, point, capsule.a, capsule.b).distance - capsule.radius);
        if (distance < nearest - 1e-12) {
          nearest = distance;
          label = tube.id;
        }
      }
    }
    ASSERT_EQ(labels[i], label) << "point " << points[i];
  }
}

TEST(LabelByNearest, ReachesFartherAroundAThickTube) {
  const Tube thin = test::chain(1, 0.004, {{-0.1, 0, 0.004}, {0.1, 0, 0.004}});
  const Tube thick = test::chain(2, 0.025, {{-0.1, 0.5, 0.025}, {0.1, 0.5, 0.025}});
  const PointCloud cloud = cloud_of({{0, 0, 0.011F}, {0, 0, 0.009F}, {0, 0.5F, 0.06F}});
  EXPECT_THAT(label_by_nearest(cloud, {0, 1, 2}, {thin, thick}, {}), ElementsAre(null_label, 1, 2));
}

// From x = −0.25 to 0.25, with the face at either end.
TEST(LabelByNearest, DoesNotReachBeyondAFlatEnd) {
  Tube tube = test::straight_tube(1, 0);
  const PointCloud cloud = cloud_of({{0.25F, 0.005F, 0.01F},
                                     {0.255F, 0.005F, 0.01F},
                                     {0.262F, 0, 0.0125F},
                                     {-0.262F, 0, 0.0125F},
                                     {-0.2F, 0, 0.025F},
                                     {0, 0, 0.0125F}});
  const std::vector<std::size_t> all = {0, 1, 2, 3, 4, 5};
  EXPECT_THAT(label_by_nearest(cloud, all, {tube}, {}), ElementsAre(null_label, 1, 1, 1, 1, null_label));
  tube.flat_ends = true;
  EXPECT_THAT(label_by_nearest(cloud, all, {tube}, {}),
              ElementsAre(1, 1, null_label, null_label, 1, null_label));
}

// Only the outermost nodes of a bent tube are ends.
TEST(LabelByNearest, TakesTheBendsOfATubeWithFlatEndsAsRound) {
  Tube tube = test::chain(1, test::radius, {{-0.2, 0, 0}, {0, 0, 0}, {0, 0, -0.2}});
  tube.flat_ends = true;
  const float out = 0.7F * static_cast<float>(test::radius);
  EXPECT_THAT(label_by_nearest(cloud_of({{out, 0, out}}), {0}, {tube}, {}), ElementsAre(1));
}

// Beside a tube that lies on it, a table is nearer to the tube than a radius.
TEST(LabelByNearest, LeavesTheTableBesideATube) {
  const Tube tube = test::straight_tube(1, 0);
  const PointCloud cloud = cloud_of({{0, 0.014F, 0.001F}, {0, 0.011F, 0.02F}});
  EXPECT_THAT(label_by_nearest(cloud, {0, 1}, {tube}, {}), ElementsAre(1, 1));
  const OtherSurfaces floor{.support = {.shape = Support::Shape::plane}};
  EXPECT_THAT(label_by_nearest(cloud, {0, 1}, {tube}, {}, floor), ElementsAre(null_label, 1));
  const Eigen::Vector3f up(0, 0, 1);
  const OtherSurfaces level{.normals = {up, up}};
  EXPECT_THAT(label_by_nearest(cloud, {0, 1}, {tube}, {}, level), ElementsAre(null_label, 1));
}

TEST(LabelByNearest, TakesASurfaceThatIsNotKnownForTheTubes) {
  const Eigen::Vector3f unknown = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  EXPECT_THAT(label_by_nearest(cloud_of({{0, 0.014F, 0.001F}}), {0}, {test::straight_tube(1, 0)}, {},
                               {.normals = {unknown}}),
              ElementsAre(1));
}

TEST(LabelByNearest, WithoutTubesOrPointsIsNullOrNothing) {
  const PointCloud cloud = cloud_of({{0, 0, 0.1F}, {0, 0, 0.2F}});
  EXPECT_THAT(label_by_nearest(cloud, {0, 1}, {}, {}), Each(null_label));
  EXPECT_TRUE(label_by_nearest(cloud, {}, {test::straight_tube(1, 0)}, {}).empty());
}

TEST(LabelPoints, CallsBinWhatIsOfTheBinAndNullWhatWasNotLookedAt) {
  // On the floor; beside a tube, and on it, claimed by another; far outside of the bin.
  const PointCloud cloud =
      cloud_of({{0, 0.1F, 0}, {0, 0.013F, 0.0125F}, {0.1F, 0.0125F, 0.0125F}, {0, 0.013F, 5}});
  const Cropped cropped{.kept = {1, 2}, .support = {0}, .outside = {3}, .near = {}};
  const std::vector<std::int32_t> claimed = {null_label, null_label, 7, null_label};
  EXPECT_THAT(label_points(cloud, cropped, claimed, {test::straight_tube(1, 0)}, {}),
              ElementsAre(bin_label, 1, 7, null_label));
}

}  // namespace
}  // namespace tanglebin
