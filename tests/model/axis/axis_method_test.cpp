#include "tanglebin/model/axis/axis_method.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/base/random.hpp"
#include "tanglebin/io/configuration.hpp"
#include "tanglebin/score/score.hpp"
#include "tanglebin/score/score_tubes.hpp"
#include "tests/model/scene/ray_cast.hpp"
#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::cloud_of;
using test::paper_scene;
using test::scanned;
using testing::IsEmpty;

AxisModel modelled(const PointCloud& cloud, const SegmentTree& segments = {{1, 2, 0.5}}) {
  KnownScene known = paper_scene();
  known.kinds[0].segments = segments;
  return model_by_axes(cloud, known, 1, 1);
}

double micro_recall(const PointCloud& cloud, const AxisModel& found) {
  return score(cloud.labels, found.model.labels).micro_recall;
}

// Three pieces at node 0, from where its arms go out.
Tube star(const std::vector<Vector3d>& nodes) {
  Tube tube{.id = 1, .radius = 0.0125, .mass = 0.5, .nodes = {}, .edges = {}};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    tube.nodes.push_back({static_cast<int>(i) + 1, nodes[i]});
    if (i == 0) continue;
    tube.edges.push_back({0, i, 1});
  }
  return tube;
}

TEST(AxisMethod, MeasuresATube) {
  // Half a metre with two bends of about 30°.
  const std::vector<Tube> tubes = {test::chain(
      1, 0.0125,
      {{-0.23, -0.05, 0.0125}, {-0.07, -0.05, 0.0125}, {0.07, 0.03, 0.0125}, {0.25, 0.03, 0.0125}})};
  const PointCloud cloud = scanned(tubes);
  const AxisModel found = modelled(cloud);
  ASSERT_EQ(found.model.tubes.size(), 1U);
  EXPECT_EQ(micro_recall(cloud, found), 1);
  const TubesScore tubes_score = score_tubes(tubes, found.model.tubes);
  EXPECT_LT(*tubes_score.centre_line_error, 0.0001);
  EXPECT_LT(*tubes_score.centre_line_error_p95, 0.0005);
  EXPECT_NEAR(total_length(found.model.tubes[0]), total_length(tubes[0]), 0.002);
}

TEST(AxisMethod, TellsTubesApartThatTouchAlongTheirLength) {
  const PointCloud cloud = scanned({test::straight_tube(1, 0), test::straight_tube(2, 0.025)});
  const AxisModel found = modelled(cloud);
  EXPECT_EQ(found.model.tubes.size(), 2U);
  EXPECT_GT(micro_recall(cloud, found), 0.999);
}

TEST(AxisMethod, JoinsWhatAnotherTubeHides) {
  const PointCloud cloud =
      scanned({test::straight_tube(1, 0), test::chain(2, 0.0125, {{0.05, -0.15, 0.04}, {0.02, 0.15, 0.04}})});
  const AxisModel found = modelled(cloud);
  EXPECT_EQ(found.kinds[0].fragments.size(), 3U);
  EXPECT_EQ(found.model.tubes.size(), 2U);
  EXPECT_EQ(micro_recall(cloud, found), 1);
}

TEST(AxisMethod, DoesNotJoinWhatIsSeenToBeApart) {
  const PointCloud cloud = scanned({test::chain(1, 0.0125, {{-0.25, 0, 0.0125}, {-0.05, 0, 0.0125}}),
                                    test::chain(2, 0.0125, {{0.02, 0, 0.0125}, {0.2, 0, 0.0125}})});
  EXPECT_EQ(modelled(cloud).model.tubes.size(), 2U);
}

// The sensor is above the middle of the bin.
TEST(AxisMethod, SaysNothingOfATubeThatIsHidden) {
  const PointCloud cloud = scanned({test::chain(1, 0.0125, {{-0.25, 0, 0.038}, {0.25, 0, 0.038}}),
                                    test::chain(2, 0.0125, {{-0.2, 0, 0.0125}, {0.2, 0, 0.0125}})});
  ASSERT_EQ(std::ranges::count(cloud.labels, 2), 0);
  const AxisModel found = modelled(cloud);
  EXPECT_EQ(found.model.tubes.size(), 1U);
  EXPECT_EQ(micro_recall(cloud, found), 1);
}

// In each pair one tube hides a part of the other.
TEST(AxisMethod, FindsTubesOfSeveralRadii) {
  const std::vector<Tube> tubes = {test::chain(1, 0.008, {{-0.2, 0.1, 0.008}, {0.2, 0.1, 0.008}}),
                                   test::chain(2, 0.0125, {{0.0, -0.05, 0.03}, {0.02, 0.16, 0.03}}),
                                   test::chain(3, 0.0125, {{-0.2, -0.1, 0.0125}, {0.2, -0.1, 0.0125}}),
                                   test::chain(4, 0.008, {{-0.1, -0.16, 0.034}, {-0.1, 0.05, 0.034}})};
  const PointCloud cloud = scanned(tubes);
  KnownScene known = paper_scene();
  known.kinds = {{.radius = 0.008, .segments = {{1, 2, 0.4}}}, {.radius = 0.0125, .segments = {{1, 2, 0.4}}}};
  const AxisModel found = model_by_axes(cloud, known, 1, 1);
  ASSERT_EQ(found.model.tubes.size(), 4U);
  EXPECT_GT(micro_recall(cloud, found), 0.999);
  EXPECT_LT(*score_tubes(tubes, found.model.tubes).centre_line_error, 0.0002);
  EXPECT_EQ(std::ranges::count(found.model.tubes, 0.008, &Tube::radius), 2);
}

TEST(AxisMethod, FollowsATubeThatCrossesItselfInTheImage) {
  const PointCloud cloud = scanned({test::chain(1, 0.0125,
                                                {{-0.1, 0, 0.0125},
                                                 {0.05, 0, 0.0125},
                                                 {0.12, 0.06, 0.03},
                                                 {0.05, 0.12, 0.05},
                                                 {-0.02, 0.06, 0.06},
                                                 {0.0, -0.08, 0.06}})});
  const AxisModel found = modelled(cloud, {{1, 2, 0.6}});
  EXPECT_EQ(found.model.tubes.size(), 1U);
  EXPECT_GT(micro_recall(cloud, found), 0.999);
}

TEST(AxisMethod, FindsATubeThatStandsUpright) {
  const PointCloud cloud = scanned({test::chain(1, 0.0125, {{0.1, 0.05, 0.0125}, {0.1, 0.05, 0.3}})});
  const AxisModel found = modelled(cloud);
  EXPECT_EQ(found.model.tubes.size(), 1U);
  // Its top is seen, and of its side a point every few centimetres: these have no neighbours to tell a normal
  // from.
  EXPECT_GT(micro_recall(cloud, found), 0.7);
}

// What is known of the star below.
const SegmentTree star_segments = {{1, 2, 0.2}, {1, 3, 0.128}, {1, 4, 0.128}};

TEST(AxisMethod, FindsJunctionsWhereThereMayBeSome) {
  const std::vector<Tube> tubes = {
      star({{0, 0, 0.0125}, {-0.2, 0, 0.0125}, {0.1, 0.08, 0.0125}, {0.1, -0.08, 0.0125}})};
  const PointCloud cloud = scanned(tubes);
  const AxisModel found = modelled(cloud, star_segments);
  ASSERT_EQ(found.model.tubes.size(), 1U);
  EXPECT_EQ(micro_recall(cloud, found), 1);
  const Tube& tree = found.model.tubes[0];
  std::vector<int> degrees(tree.nodes.size());
  Vector3d junction(1, 1, 1);
  for (const Edge& edge : tree.edges) {
    for (const std::size_t node : {edge.from, edge.to}) {
      if (++degrees[node] == 3) junction = tree.nodes[node].position;
    }
  }
  EXPECT_EQ(std::ranges::count(degrees, 3), 1);
  EXPECT_EQ(std::ranges::count(degrees, 1), 3);
  EXPECT_LT((junction - tubes[0].nodes[0].position).norm(), 0.01);
}

TEST(AxisMethod, WritesTubesThatCanBeRead) {
  const std::vector<Tube> tubes = {
      star({{0, 0, 0.0125}, {-0.2, 0, 0.0125}, {0.1, 0.08, 0.0125}, {0.1, -0.08, 0.0125}})};
  const AxisModel found = modelled(scanned(tubes), star_segments);
  std::stringstream text;
  write_configuration(text, found.model.tubes);
  EXPECT_EQ(read_configuration(text, "tubes.txt").size(), found.model.tubes.size());
}

TEST(AxisMethod, FindsNothingInABallThatIsNoTube) {
  std::vector<Eigen::Vector3f> ball;
  constexpr int steps = 200;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const Vector3d p(-0.06 + 0.12 * i / steps, -0.06 + 0.12 * j / steps, 0);
      if (p.norm() < 0.058) ball.emplace_back(p.x(), p.y(), 0.06 + std::sqrt(0.0036 - p.squaredNorm()));
    }
  }
  EXPECT_THAT(modelled(cloud_of(ball)).model.tubes, IsEmpty());
}

// All lengths are in radii, but for how near to the bin a point is the bin's. A power of two scales exactly.
TEST(AxisMethod, DoesNotDependOnTheScale) {
  const std::vector<Tube> tubes = {
      test::straight_tube(1, 0), test::chain(2, 0.0125, {{0.05, -0.15, 0.04}, {0.02, 0.15, 0.04}}),
      test::chain(3, 0.0125, {{-0.2, -0.1, 0.0125}, {-0.1, 0, 0.0125}, {-0.15, 0.12, 0.0125}})};
  PointCloud cloud = scanned(tubes);
  const Vector3d sensor = paper_scene().camera.pose.translation();
  Rng rng(1);
  for (Eigen::Vector3f& point : cloud.points) {
    const Vector3d ray = (point.cast<double>() - sensor).normalized();
    point += (0.0005 * uniform_real(rng, -1, 1) * ray).cast<float>();
  }
  const auto labels_at = [&](float scale) {
    PointCloud scaled = cloud;
    for (Eigen::Vector3f& point : scaled.points) point *= scale;
    KnownScene known = paper_scene();
    AxisSettings settings;
    for (double* length : {&known.support.bin.length, &known.support.bin.width, &known.support.bin.height,
                           &known.support.bin.wall, &known.kinds[0].radius, &settings.filter.margin,
                           &settings.filter.overhang})
      *length *= scale;
    known.camera.pose.translation() *= scale;
    known.kinds[0].segments = {{1, 2, 0.5 * scale}};
    return model_by_axes(scaled, known, 1, 1, settings).model.labels;
  };
  const std::vector<std::int32_t> labels = labels_at(1);
  EXPECT_GT(score(cloud.labels, labels).micro_recall, 0.99);
  for (const float scale : {0.25F, 0.5F, 2.0F, 4.0F}) EXPECT_EQ(labels_at(scale), labels) << scale;
}

// Bars on a table whose height is known to 2 mm.
TEST(AxisMethod, FindsTubesThatLieLowerThanTheKnownFloorAllows) {
  PointCloud cloud = scanned({test::straight_tube(1, 0), test::straight_tube(2, 0.05)});
  for (Eigen::Vector3f& point : cloud.points) point.z() -= 0.0045F;
  const AxisModel found = modelled(cloud);
  ASSERT_EQ(found.model.tubes.size(), 2U);
  for (const Tube& tube : found.model.tubes) EXPECT_NEAR(total_length(tube), 0.5, 0.01);
}

// A floor told 8 mm too high, in which the lower tube would be.
TEST(AxisMethod, JoinsWhatLiesLowerThanTheKnownFloorIfThatMayBeOffByAsMuch) {
  PointCloud cloud =
      scanned({test::straight_tube(1, 0), test::chain(2, 0.0125, {{0.05, -0.15, 0.04}, {0.02, 0.15, 0.04}})});
  for (Eigen::Vector3f& point : cloud.points) point.z() -= 0.008F;
  KnownScene known = paper_scene();
  known.kinds[0].segments = {{1, 2, 0.5}};
  EXPECT_EQ(model_by_axes(cloud, known, 1, 1).model.tubes.size(), 1U);
  known.support.margin = 0.008;
  const AxisModel found = model_by_axes(cloud, known, 1, 1);
  EXPECT_EQ(found.model.tubes.size(), 2U);
  EXPECT_GT(micro_recall(cloud, found), 0.99);
}

// Three tubes in so much noise that their votes hardly hang together.
TEST(AxisMethod, CutsVotesAgainWhereItIsNotSure) {
  KnownScene known = paper_scene();
  known.kinds[0].segments = {{1, 2, 0.5}};
  PointCloud cloud =
      scanned({test::straight_tube(1, -0.05), test::straight_tube(2, -0.02), test::straight_tube(3, 0.04)});
  Rng rng(5);
  for (Eigen::Vector3f& point : cloud.points) {
    for (int axis = 0; axis < 3; ++axis) point[axis] += static_cast<float>(uniform_real(rng, -0.004, 0.004));
  }
  constexpr int until_votes = 2;
  constexpr int after = 4;
  for (const auto& [sure_min, cuts] : {std::pair(0.0, 1), std::pair(1.0, 4)}) {
    AxisSettings settings;
    settings.fragment.sure_min = sure_min;
    int steps = 0;
    const AxisModel found = model_by_axes(cloud, known, 1, 1, settings, [&] { ++steps; });
    EXPECT_EQ(steps, until_votes + cuts * after);
    std::vector<std::string> names;
    for (const Step& step : found.model.steps) names.push_back(step.name);
    EXPECT_THAT(names, testing::ElementsAre("filter", "vote", "fragment", "join", "fit", "label"));
    EXPECT_GT(micro_recall(cloud, found), 0.99);
  }
}

TEST(AxisMethod, DoesNotCutTheVotesOfNoiseAgain) {
  Rng rng(8);
  PointCloud noise;
  for (int i = 0; i < 20000; ++i) {
    const double x = uniform_real(rng, -0.2, 0.2);
    const double y = uniform_real(rng, -0.15, 0.15);
    noise.points.push_back(Vector3d(x, y, uniform_real(rng, 0.02, 0.15)).cast<float>());
  }
  KnownScene known = paper_scene();
  known.kinds[0].segments = {{1, 2, 0.5}};
  int steps = 0;
  const AxisModel found = model_by_axes(noise, known, 1, 1, {}, [&] { ++steps; });
  EXPECT_THAT(found.model.tubes, testing::Not(IsEmpty()));
  EXPECT_EQ(steps, 6);
}

// The top of a ball as thick as the tube: fifty points, of which half a radius of the tube has more.
TEST(AxisMethod, FindsNoTubeInASpeckBesideOne) {
  PointCloud cloud = scanned({test::straight_tube(1, 0)});
  const std::size_t without = cloud.points.size();
  constexpr double step = 0.0015;  // m, the camera's pixels
  for (int i = -4; i <= 4; ++i) {
    for (int j = -4; j <= 4; ++j) {
      const Vector3d p(i * step, j * step, 0);
      if (p.norm() > 4 * step) continue;
      const double up = std::sqrt(0.0125 * 0.0125 - p.squaredNorm());
      cloud.points.push_back((Vector3d(0, -0.1, 0.02 + up) + p).cast<float>());
      cloud.labels.push_back(0);
    }
  }
  cloud.width = cloud.points.size();
  cloud.colors.clear();
  ASSERT_GT(cloud.points.size(), without + 40);
  const AxisModel found = modelled(cloud);
  EXPECT_GT(found.kinds[0].fragments.size(), 1U);
  EXPECT_EQ(found.model.tubes.size(), 1U);
}

TEST(AxisMethod, FindsNothingInNoise) {
  Rng rng(1);
  std::vector<Eigen::Vector3f> noise;
  for (int i = 0; i < 5000; ++i) {
    noise.push_back(
        Vector3d(uniform_real(rng, -0.25, 0.25), uniform_real(rng, -0.15, 0.15), uniform_real(rng, 0.01, 0.2))
            .cast<float>());
  }
  EXPECT_THAT(modelled(cloud_of(noise)).model.tubes, IsEmpty());
}

// Box and Muller 1958.
double normal_number(Rng& rng) {
  const double radius = std::sqrt(-2 * std::log(1 - uniform_real(rng, 0, 1)));
  return radius * std::cos(2 * std::numbers::pi * uniform_real(rng, 0, 1));
}

// The depth of each pixel is the mean of five along its row. In the middle of an edge is the pixel's own
// surface.
TEST(AxisMethod, PutsAPointBetweenTwoTubesOnTheOneThatItHasMoreOf) {
  constexpr double radius = 0.006;
  const Camera camera = test::near_camera();
  const PointCloud sharp =
      test::seen_by(camera, {{1, test::flat_cylinder({-0.1, 0, 0}, {0.1, 0, 0}, radius)},
                             {2, test::flat_cylinder({0, -0.1, 0.021}, {0, 0.1, 0.021}, radius)}});
  PointCloud blended = sharp;
  std::vector<std::size_t> between;
  for (std::size_t i = 2; i + 2 < sharp.points.size(); ++i) {
    const auto pixel = [&](std::size_t of) {
      return seen_pixel(camera, sharp.points[of].cast<double>())->pixel;
    };
    const bool is_inside =
        pixel(i - 2).row == pixel(i + 2).row && pixel(i - 2).column + 4 == pixel(i + 2).column;
    if (!is_inside) continue;
    double depth = 0;
    for (std::size_t j = i - 2; j <= i + 2; ++j)
      depth += depth_of(camera, sharp.points[j].cast<double>()) / 5;
    const Ray ray = ray_through(camera, pixel(i).column, pixel(i).row);
    const double scale = depth / depth_of(camera, ray.origin + ray.direction);
    blended.points[i] = (ray.origin + scale * ray.direction).cast<float>();
    if (sharp.labels[i - 2] != sharp.labels[i + 2]) between.push_back(i);
  }
  KnownScene known{.support = {.shape = Support::Shape::nothing}, .camera = camera};
  known.kinds[0] = {.radius = radius, .segments = {{1, 2, 0.2}}, .flat_ends = true};
  const Model model = model_by_axes(blended, known, 1, 1).model;
  ASSERT_EQ(model.tubes.size(), 2U);
  const bool is_first_one = model.labels.front() == sharp.labels.front();
  const auto is_right = [&](std::size_t i) {
    return model.labels[i] == (is_first_one ? sharp.labels[i] : 3 - sharp.labels[i]);
  };
  EXPECT_GT(between.size(), 100U);
  EXPECT_TRUE(std::ranges::all_of(between, is_right));
}

TEST(AxisMethod, BearsNoise) {
  PointCloud cloud = scanned({test::straight_tube(1, 0), test::straight_tube(2, 0.025),
                              test::chain(3, 0.0125, {{0.05, -0.15, 0.04}, {0.02, 0.15, 0.04}})});
  Rng rng(1);
  const Vector3d sensor = paper_scene().camera.pose.translation();
  for (Eigen::Vector3f& point : cloud.points) {
    const Vector3d ray = (point.cast<double>() - sensor).normalized();
    point += (0.0005 * normal_number(rng) * ray).cast<float>();
  }
  const AxisModel found = modelled(cloud);
  EXPECT_EQ(found.model.tubes.size(), 3U);
  const auto all =
      static_cast<double>(std::ranges::count_if(cloud.labels, [](int label) { return label > 0; }));
  EXPECT_GT(micro_recall(cloud, found), 0.99) << all;
}

}  // namespace
}  // namespace tanglebin
