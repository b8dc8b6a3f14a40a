#include "tanglebin/model/axis/fragments/axis_votes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>

#include "tanglebin/geometry/capsule.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using test::paper_scene;
using test::scanned;

std::vector<Eigen::Vector3f> points_of(const PointCloud& cloud, std::int32_t label) {
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.labels[i] == label) points.push_back(cloud.points[i]);
  }
  return points;
}

double distance_from_axes(const std::vector<Tube>& tubes, const Eigen::Vector3f& vote) {
  double nearest = 1;
  for (const Tube& tube : tubes) {
    for (const Capsule& capsule : capsules(tube)) {
      nearest = std::min(nearest, axis_distance(capsule, vote.cast<double>()));
    }
  }
  return nearest;
}

std::ptrdiff_t count_votes(const AxisVotes& votes) {
  return std::ranges::count_if(votes.votes, [](const auto& vote) { return vote.allFinite(); });
}

using test::radius;

AxisVotes votes_of(const std::vector<Eigen::Vector3f>& points) {
  const KnownScene scene = paper_scene();
  return vote_for_axes(points, scene.support, scene.camera, radius, {});
}

TEST(AxisVotes, OfAScannedTubeAreOnItsAxis) {
  const std::vector<Tube> tubes = {
      test::chain(1, 0.0125, {{-0.2, -0.05, 0.0125}, {0, 0, 0.05}, {0.2, -0.03, 0.1}})};
  const std::vector<Eigen::Vector3f> points = points_of(scanned(tubes), 1);
  const AxisVotes votes = votes_of(points);
  ASSERT_EQ(votes.votes.size(), points.size());
  EXPECT_GT(count_votes(votes), 0.98 * static_cast<double>(points.size()));
  std::vector<double> errors;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!votes.votes[i].allFinite()) continue;
    errors.push_back(distance_from_axes(tubes, votes.votes[i]));
    EXPECT_NEAR(votes.normals[i].norm(), 1, 1e-5);
    EXPECT_LT(errors.back(), 0.003);
  }
  std::ranges::sort(errors);
  EXPECT_LT(errors[errors.size() / 2], 0.0003);
  EXPECT_LT(errors[errors.size() * 95 / 100], 0.001);
}

TEST(AxisVotes, OfTubesThatTouchStayADiameterApart) {
  const std::vector<Tube> tubes = {test::straight_tube(1, 0), test::straight_tube(2, 0.025)};
  const PointCloud cloud = scanned(tubes);
  std::vector<Eigen::Vector3f> points = points_of(cloud, 1);
  std::ranges::copy(points_of(cloud, 2), std::back_inserter(points));
  const AxisVotes votes = votes_of(points);
  EXPECT_GT(count_votes(votes), 0.85 * static_cast<double>(points.size()));
  for (const Eigen::Vector3f& vote : votes.votes) {
    if (!vote.allFinite()) continue;
    EXPECT_LT(distance_from_axes(tubes, vote), 0.004);
  }
}

// The points of a half of a cylinder along x, as a camera far above it sees them.
std::vector<Eigen::Vector3f> half_cylinder(double spacing) {
  std::vector<Eigen::Vector3f> points;
  for (double x = -0.05; x <= 0.05; x += spacing) {
    for (double y = -0.9 * radius; y <= 0.9 * radius; y += spacing)
      points.push_back(Eigen::Vector3d(x, y, 0.1 + std::sqrt(radius * radius - y * y)).cast<float>());
  }
  return points;
}

// Where points are dense, neighbours share a vote. None loses its own by that, wherever its row begins.
TEST(AxisVotes, AreSharedWherePointsAreDense) {
  KnownScene scene = paper_scene();
  scene.camera.fx *= 10;
  scene.camera.fy *= 10;
  scene.camera.width *= 10;
  scene.camera.height *= 10;
  scene.camera.cx *= 10;
  scene.camera.cy *= 10;
  const std::vector<Eigen::Vector3f> points = half_cylinder(0.0004);
  VoteSettings of_all;
  of_all.patch.at_every_point = true;
  const AxisVotes shared = vote_for_axes(points, scene.support, scene.camera, radius, {});
  const AxisVotes own = vote_for_axes(points, scene.support, scene.camera, radius, of_all);
  EXPECT_GE(count_votes(shared), 0.999 * static_cast<double>(count_votes(own)));
  const auto different = [](const AxisVotes& votes) {
    std::set<std::array<float, 3>> places;
    for (const Eigen::Vector3f& vote : votes.votes)
      if (vote.allFinite()) places.insert({vote.x(), vote.y(), vote.z()});
    return places.size();
  };
  EXPECT_LT(2 * different(shared), different(own));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!shared.votes[i].allFinite() || !own.votes[i].allFinite()) continue;
    EXPECT_LT((shared.votes[i] - own.votes[i]).norm(), 0.36 * radius + 0.001);
    EXPECT_LT(std::hypot(shared.votes[i].y(), shared.votes[i].z() - 0.1F), 0.002);
  }
}

TEST(AxisVotes, DoNotLieInTheBin) {
  // The floor's own points, raised by noise, would be tubes under the floor.
  std::vector<Eigen::Vector3f> floor;
  for (int i = 0; i < 10000; ++i) {
    floor.emplace_back(0.001F * static_cast<float>(i % 100), 0.001F * static_cast<float>(i / 100), 0.007F);
  }
  EXPECT_EQ(count_votes(votes_of(floor)), 0);
}

TEST(AxisVotes, NeedNeighbours) {
  const std::vector<Eigen::Vector3f> few = {{0, 0, 0.1F}, {0.001F, 0, 0.1F}, {0, 0.001F, 0.1F}};
  EXPECT_EQ(count_votes(votes_of(few)), 0);
  EXPECT_EQ(count_votes(votes_of({})), 0);
}

}  // namespace
}  // namespace tanglebin
