#include "tanglebin/model/scene/weigh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tanglebin/model/model_tubes.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using test::paper_scene;
using test::scanned;

// The upper half of a straight tube's surface, from `first` to `last` along it (m), with this radius.
PointCloud upper_half(const Tube& tube, double radius, double first, double last) {
  const Eigen::Vector3d start = tube.nodes[0].position;
  const Eigen::Vector3d along = (tube.nodes[1].position - start).normalized();
  const Eigen::Vector3d sideways = Eigen::Vector3d::UnitZ().cross(along);
  std::vector<Eigen::Vector3f> points;
  constexpr int turns = 20;
  for (double at = first; at < last; at += 0.002) {
    for (int turn = 0; turn <= turns; ++turn) {
      const double angle = std::numbers::pi * turn / turns;
      const Eigen::Vector3d outwards =
          std::cos(angle) * sideways + std::sin(angle) * Eigen::Vector3d::UnitZ();
      points.push_back((start + at * along + radius * outwards).cast<float>());
    }
  }
  return test::cloud_of(points);
}

/// A straight tube of half a metre, of which a cloud shows something.
class Evidence : public testing::Test {
protected:
  TubeEvidence weighed(const PointCloud& cloud) const {
    Model model;
    model.tubes = {tube_};
    model.labels.assign(cloud.points.size(), 1);
    model.evidence.resize(1);
    weigh(model, cloud, scene_);
    return model.evidence[0];
  }

  Tube tube_ = test::straight_tube(1, 0);
  KnownScene scene_ = paper_scene();
};

TEST_F(Evidence, OfAWholeTubeIsComplete) {
  scene_.kinds[0].length_min = 0.5;
  const TubeEvidence evidence = weighed(upper_half(tube_, test::radius, 0, 0.5));
  EXPECT_EQ(evidence.points, 250U * 21);
  EXPECT_NEAR(evidence.residual, 0, 1e-6);
  EXPECT_NEAR(evidence.radius_error, 0, 1e-6);
  EXPECT_NEAR(evidence.length, 0.5, 1e-12);
  EXPECT_NEAR(evidence.coverage(), 1, 0.03);
  EXPECT_EQ(evidence.length_fit, LengthFit::complete);
}

TEST_F(Evidence, CoversWhatWasSeen) {
  EXPECT_NEAR(weighed(upper_half(tube_, test::radius, 0.1, 0.3)).visible_length, 0.2, 2 * test::radius);
  EXPECT_EQ(weighed(test::cloud_of({})).visible_length, 0);
}

// A cable of four metres has more parts than any fixed number of points can show.
TEST_F(Evidence, CoversAllOfALongThinTube) {
  tube_ = test::chain(1, 0.0025, {{-2, 0, 0.0025}, {2, 0, 0.0025}});
  scene_.kinds[0].radius = tube_.radius;
  EXPECT_NEAR(weighed(upper_half(tube_, tube_.radius, 0, 4)).coverage(), 1, 0.03);
}

// The model of a tube that is cut flat may be a little too long. Then its face lies inside of the model.
TEST_F(Evidence, ResidualIsNotThatOfAFace) {
  PointCloud cloud = upper_half(tube_, test::radius, 0.002, 0.498);
  for (double across = 0; across < test::radius; across += 0.0001)
    cloud.points.emplace_back(-0.248F, 0.0F, static_cast<float>(test::radius + across));
  EXPECT_GT(weighed(cloud).residual, 1e-4);
  tube_.flat_ends = true;
  EXPECT_NEAR(weighed(cloud).residual, 0, 1e-6);
}

TEST_F(Evidence, SaysWhetherTheLengthFits) {
  const PointCloud cloud = upper_half(tube_, test::radius, 0, 0.5);
  const auto fit = [&](double length_min, double length_max) {
    scene_.kinds[0].length_min = length_min;
    scene_.kinds[0].segments = {{1, 2, length_max}};
    return weighed(cloud).length_fit;
  };
  EXPECT_EQ(fit(0.4, 0.6), LengthFit::complete);
  EXPECT_EQ(fit(0.3, 0.4), LengthFit::too_long);
  EXPECT_EQ(fit(0.6, 0.7), LengthFit::too_short);
  EXPECT_EQ(fit(0, std::numeric_limits<double>::infinity()), LengthFit::unknown);
}

TEST_F(Evidence, FeelsARadiusThatIsWrongAlthoughTheTubeWasFitted) {
  const double seen_radius = 1.1 * test::radius;
  Tube thick = tube_;
  for (Node& node : thick.nodes) node.position.z() = 0.1;
  const PointCloud cloud = upper_half(thick, seen_radius, 0, 0.5);
  // A fit moves the thinner tube up, by the mean over the half circle of what it lacks.
  tube_ = thick;
  const double lacking = seen_radius - test::radius;
  for (Node& node : tube_.nodes) node.position.z() += lacking * 4 / std::numbers::pi;
  EXPECT_NEAR(weighed(cloud).radius_error, lacking, 0.1 * lacking);
}

TEST_F(Evidence, FeelsTheRadiusInSpiteOfAFewPointsOfANeighbour) {
  PointCloud cloud = upper_half(tube_, test::radius, 0, 0.5);
  const PointCloud neighbour = upper_half(tube_, 1.5 * test::radius, 0, 0.5);
  const std::size_t middle = cloud.points.size() / 2;
  for (std::size_t i = middle; i < cloud.points.size(); i += 5) {
    if (i % 21 < 5) cloud.points[i] = neighbour.points[i];
  }
  EXPECT_NEAR(weighed(cloud).radius_error, 0, 1e-6);
  EXPECT_GT(std::abs(weighed(cloud).unevenness), 0.02 * test::radius);
}

TEST_F(Evidence, ResidualIsTheScatterAboutTheSurface) {
  PointCloud cloud = upper_half(tube_, test::radius, 0, 0.5);
  const PointCloud outer = upper_half(tube_, test::radius + 0.001, 0, 0.5);
  for (std::size_t i = 0; i < cloud.points.size(); i += 5) cloud.points[i] = outer.points[i];
  EXPECT_NEAR(weighed(cloud).residual, 0.001 * std::sqrt(0.2), 2e-5);
}

TEST(EvidenceOfAModel, OneForEachTubeByEveryMethod) {
  const std::vector<Tube> tubes = {test::straight_tube(1, -0.1), test::straight_tube(2, 0.1),
                                   test::chain(3, test::radius, {{0, -0.15, 0.05}, {0, 0.15, 0.05}})};
  const PointCloud cloud = scanned(tubes);
  for (const Method method : methods()) {
    const Model model = model_tubes(cloud, paper_scene(), {.method = method});
    ASSERT_EQ(model.evidence.size(), model.tubes.size());
    std::size_t joins = 0;
    for (std::size_t i = 0; i < model.tubes.size(); ++i) {
      EXPECT_GT(model.evidence[i].points, 100U);
      EXPECT_LT(model.evidence[i].residual, 0.001);
      joins += model.evidence[i].joins.size();
    }
    // The crossing tube hides a piece of each of the others.
    EXPECT_EQ(joins, method == Method::axis ? 2U : 0U);
  }
}

TEST(EvidenceOfAModel, IsInTheWorldFrame) {
  const std::vector<Tube> tubes = {test::straight_tube(1, 0),
                                   test::chain(2, test::radius, {{0, -0.15, 0.05}, {0, 0.15, 0.05}})};
  PointCloud cloud = scanned(tubes);
  KnownScene scene = paper_scene();
  const Model here = model_tubes(cloud, scene);
  ASSERT_EQ(here.evidence[0].joins.size() + here.evidence[1].joins.size(), 1U);
  const Eigen::Isometry3d motion(Eigen::Translation3d(1, 2, 3));
  for (Eigen::Vector3f& point : cloud.points) point = (motion * point.cast<double>()).cast<float>();
  scene.support.pose = motion * scene.support.pose;
  scene.camera.pose = motion * scene.camera.pose;
  const Model there = model_tubes(cloud, scene);
  ASSERT_EQ(there.evidence.size(), here.evidence.size());
  for (std::size_t i = 0; i < here.evidence.size(); ++i) {
    ASSERT_EQ(there.evidence[i].joins.size(), here.evidence[i].joins.size());
    for (std::size_t j = 0; j < here.evidence[i].joins.size(); ++j) {
      EXPECT_LT((there.evidence[i].joins[j].from - motion * here.evidence[i].joins[j].from).norm(), 1e-4);
      EXPECT_LT((there.evidence[i].joins[j].to - motion * here.evidence[i].joins[j].to).norm(), 1e-4);
    }
  }
}

}  // namespace
}  // namespace tanglebin
