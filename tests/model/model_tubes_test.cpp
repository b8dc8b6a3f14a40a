#include "tanglebin/model/model_tubes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "tanglebin/base/error.hpp"
#include "tanglebin/model/axis/axis_method.hpp"
#include "tanglebin/model/paper/paper_method.hpp"
#include "tanglebin/model/parameters.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/score/score.hpp"
#include "tests/model/scene/scanned.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using test::cloud_of;
using test::paper_scene;
using test::scanned;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;

// Three bent tubes: one on the floor, one leaning over it, one alone.
std::vector<Tube> three_tubes() {
  return {test::chain(1, 0.0125,
                      {{-0.2, -0.05, 0.0125}, {-0.05, 0, 0.0125}, {0.1, 0, 0.0125}, {0.25, 0.06, 0.0125}}),
          test::chain(2, 0.0125, {{0.02, -0.17, 0.0125}, {0.02, 0, 0.06}, {0.03, 0.16, 0.0125}}),
          test::chain(3, 0.0125, {{-0.25, 0.12, 0.0125}, {-0.12, 0.15, 0.0125}, {-0.05, 0.1, 0.0125}})};
}

/// What every method must do.
class ModelTubes : public testing::TestWithParam<Method> {
protected:
  static Model modelled(const PointCloud& cloud, double ratio = 1) {
    return model_tubes(cloud, paper_scene(), {.method = GetParam(), .ratio = ratio, .seed = 1});
  }
  static std::string complaint(const PointCloud& cloud, const KnownScene& scene, double ratio) {
    return test::complaint([&] { model_tubes(cloud, scene, {.method = GetParam(), .ratio = ratio}); });
  }
};

INSTANTIATE_TEST_SUITE_P(By, ModelTubes, testing::ValuesIn(methods()),
                         [](const auto& method) { return name_of(method.param); });

TEST_P(ModelTubes, FindsTheTubesOfAnEasyScene) {
  const PointCloud cloud = scanned(three_tubes());
  const Model model = modelled(cloud);
  EXPECT_EQ(model.tubes.size(), 3U);
  ASSERT_EQ(model.labels.size(), cloud.points.size());
  EXPECT_GT(score(cloud.labels, model.labels).micro_recall, 0.99);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    EXPECT_EQ(model.labels[i] == bin_label, cloud.labels[i] == bin_label) << "point " << i;
  }
}

TEST_P(ModelTubes, FindsTheSameOfUnknownLength) {
  const PointCloud cloud = scanned(three_tubes());
  KnownScene known = paper_scene();
  known.kinds[0].segments[0].length = std::numeric_limits<double>::infinity();
  const Model model = model_tubes(cloud, known, {.method = GetParam(), .seed = 1});
  EXPECT_EQ(model.tubes.size(), 3U);
  EXPECT_EQ(model.labels, modelled(cloud).labels);
}

TEST_P(ModelTubes, FindsThemInAShareOfThePointsAndLabelsTheRest) {
  const PointCloud cloud = scanned(three_tubes());
  const Model model = modelled(cloud, 0.3);
  const auto on_tubes = static_cast<std::size_t>(
      std::ranges::count_if(cloud.labels, [](std::int32_t label) { return label > bin_label; }));
  EXPECT_NEAR(static_cast<double>(model.filtered.size()), 0.3 * static_cast<double>(on_tubes), 1);
  EXPECT_GT(score(cloud.labels, model.labels).micro_recall, 0.98);
}

TEST_P(ModelTubes, SaysWhatEachStepLeft) {
  const Model model = modelled(scanned(three_tubes()), 0.5);
  std::vector<std::string> names;
  for (const Step& step : model.steps) {
    names.push_back(step.name);
    EXPECT_GE(step.seconds, 0);
    EXPECT_GT(step.count, 0U);
  }
  EXPECT_EQ(names, (GetParam() == Method::paper
                        ? std::vector<std::string>{"filter", "segment", "fit", "join", "label"}
                        : std::vector<std::string>{"filter", "vote", "fragment", "join", "fit", "label"}));
  EXPECT_EQ(model.steps.front().count, model.filtered.size());
}

TEST_P(ModelTubes, EndsWithWhatIsThrownAtAStep) {
  const PointCloud cloud = scanned(three_tubes());
  const ModelSettings settings{.method = GetParam()};
  std::size_t calls = 0;
  const Model model = model_tubes(cloud, paper_scene(), settings, [&] { ++calls; });
  EXPECT_GE(calls, model.steps.size());
  const auto stop = [] { throw std::runtime_error("enough"); };
  EXPECT_THROW(model_tubes(cloud, paper_scene(), settings, stop), std::runtime_error);
}

TEST_P(ModelTubes, GivesTheSameTwiceAndAnotherForAnotherSeed) {
  const PointCloud cloud = scanned(three_tubes());
  const Model first = modelled(cloud, 0.3);
  const Model again = modelled(cloud, 0.3);
  EXPECT_EQ(first.labels, again.labels);
  EXPECT_EQ(first.filtered, again.filtered);
  const Model other = model_tubes(cloud, paper_scene(), {.method = GetParam(), .ratio = 0.3, .seed = 2});
  EXPECT_NE(first.filtered, other.filtered);
}

TEST_P(ModelTubes, DoesNotLookAtLabelsAndColours) {
  PointCloud cloud = scanned(three_tubes());
  const Model with = modelled(cloud, 0.3);
  cloud.labels.clear();
  cloud.colors.clear();
  EXPECT_EQ(with.labels, modelled(cloud, 0.3).labels);
}

TEST_P(ModelTubes, OfAnOrganizedCloudLeavesItsHolesNull) {
  const KnownScene scene = paper_scene();
  const PointCloud cloud =
      organized_cloud_from_scan(scan(three_tubes(), scene.support.bin, scene.camera), CloudOf::tubes, 3);
  const Model model = modelled(cloud);
  EXPECT_EQ(model.tubes.size(), 3U);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    EXPECT_TRUE(cloud.points[i].allFinite() || model.labels[i] == null_label) << "point " << i;
  }
}

TEST_P(ModelTubes, OfHardlyAnythingIsNothing) {
  EXPECT_THAT(modelled({}).tubes, IsEmpty());
  EXPECT_THAT(modelled({}).labels, IsEmpty());
  for (const std::size_t points : {1U, 2U, 3U, 30U}) {
    // Few points, and many at one place.
    const Model model = modelled(cloud_of(std::vector<Eigen::Vector3f>(points, {0.1F, 0, 0.1F})));
    EXPECT_THAT(model.tubes, IsEmpty()) << points;
    EXPECT_THAT(model.labels, Each(null_label)) << points;
  }
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(modelled(cloud_of(std::vector<Eigen::Vector3f>(50, {nan, nan, nan}))).labels, Each(null_label));
}

TEST_P(ModelTubes, OfAnEmptyBinOrAPlaneIsNothing) {
  EXPECT_THAT(modelled(scanned({})).tubes, IsEmpty());
  std::vector<Eigen::Vector3f> plane;
  for (int i = 0; i < 10000; ++i) {
    plane.emplace_back(0.002F * static_cast<float>(i % 100) - 0.1F,
                       0.002F * static_cast<float>(i / 100) - 0.1F, 0.1F);
  }
  const Model model = modelled(cloud_of(plane));
  EXPECT_THAT(model.tubes, IsEmpty());
  EXPECT_THAT(model.labels, Each(null_label));
}

TEST_P(ModelTubes, TakesDuplicatePoints) {
  PointCloud cloud = scanned(three_tubes());
  const std::size_t points = cloud.points.size();
  cloud.points.reserve(2 * points);
  std::ranges::copy_n(cloud.points.begin(), static_cast<std::ptrdiff_t>(points),
                      std::back_inserter(cloud.points));
  cloud.labels.clear();
  cloud.colors.clear();
  cloud.width = cloud.points.size();
  const Model model = modelled(cloud);
  EXPECT_EQ(model.labels.size(), 2 * points);
}

TEST_P(ModelTubes, RefusesACloudInMillimetres) {
  PointCloud cloud = scanned(three_tubes());
  for (Eigen::Vector3f& point : cloud.points) point *= 1000;
  const Model model = modelled(cloud);
  EXPECT_TRUE(model.is_refused());
  EXPECT_THAT(model.findings.at(0).message, HasSubstr("--unit mm"));
  EXPECT_THAT(model.tubes, IsEmpty());
  EXPECT_THAT(model.labels, Each(null_label));
}

TEST_P(ModelTubes, RefusesASceneThatIsNone) {
  KnownScene scene = paper_scene();
  scene.kinds[0].radius = 0;
  EXPECT_THAT(complaint({}, scene, 1), HasSubstr("radius: found 0, expected a positive number"));
  scene.kinds[0].radius = 1e-9;
  EXPECT_THAT(complaint({}, scene, 1), HasSubstr("radius: found 1e-09 m, expected 0.0001 to 1 m"));
  scene.kinds[0].radius = 8;
  EXPECT_THAT(complaint({}, scene, 1),
              HasSubstr("radius: found 8 m, expected 0.0001 to 1 m; for 8 mm write 0.008"));
  scene.kinds[0].radius = 0.2;
  EXPECT_THAT(complaint({}, scene, 1),
              HasSubstr("radius: found 0.2 m, expected less than 0.185 m, half the bin's narrower side"));
  scene = paper_scene();
  scene.kinds[0].segments = {{1, 2, 80}};
  EXPECT_THAT(
      complaint({}, scene, 1),
      HasSubstr("length: found 80 m, expected at most 6.92 m, ten times the bin's diagonal; for 80 mm "
                "write 0.08"));
  scene.kinds[0].segments = {{1, 2, 0.3}, {1, 3, 7}};
  EXPECT_THAT(complaint({}, scene, 1), HasSubstr("kinds[0].segment: found 7.3 m, expected at most 6.92 m"));
  scene.kinds[0].segments = {{1, 2, std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_THAT(complaint({}, scene, 1),
              HasSubstr("length: found nan m from node 1 to 2, expected a positive"));
  scene.kinds[0].segments = {{1, 2, 0.3}, {1, 3, 0.1}, {3, 2, 0.1}};
  EXPECT_THAT(complaint({}, scene, 1),
              HasSubstr("kinds[0].segment: found a segment to node 2, which closes a loop"));
  for (const double length_min : {-0.1, 0.6, std::numeric_limits<double>::quiet_NaN()}) {
    scene.kinds[0].segments = {{1, 2, 0.5}};
    scene.kinds[0].length_min = length_min;
    EXPECT_THAT(complaint({}, scene, 1),
                AllOf(HasSubstr("length_min: found "),
                      HasSubstr("expected 0 if it is not known, or at most the length of 0.5 m")));
  }
  scene = paper_scene();
  scene.kinds.push_back(scene.kinds[0]);
  EXPECT_THAT(
      complaint({}, scene, 1),
      HasSubstr("kinds[1].radius: found 0.0125 m for two kinds, expected a different radius for each kind"));
  scene.kinds.clear();
  EXPECT_THAT(complaint({}, scene, 1), HasSubstr("kinds: found none"));
  EXPECT_THAT(complaint({}, paper_scene(), 0), HasSubstr("downsample: found 0, expected a ratio above 0"));
  EXPECT_THAT(complaint({}, paper_scene(), 1.5), HasSubstr("downsample: found 1.5"));
}

/// A method with parameters that nobody would choose.
class UnusualParameters : public testing::TestWithParam<Method> {
protected:
  static std::vector<Parameter> of_method() {
    std::vector<Parameter> all = declared_parameters();
    std::erase_if(all, [](const Parameter& parameter) {
      return !parameter.name.starts_with(std::string(name_of(GetParam())) + '.');
    });
    return all;
  }

  static Model modelled(const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings) {
    constexpr double ratio = 0.5;
    constexpr std::uint64_t seed = 1;
    return GetParam() == Method::paper
               ? model_as_in_paper(cloud, known, ratio, seed, settings.paper, [] {}).model
               : model_by_axes(cloud, known, ratio, seed, settings.axis, [] {}).model;
  }

  static void expect_model(const ModelSettings& settings) {
    KnownScene known = paper_scene();
    known.camera = test::camera_at({0.3, 0.2, 1.6}, {0, 0, 0}, 320, 240, 0.7);
    // Without the bin's points, which are many if the filter leaves them.
    static const PointCloud cloud =
        cloud_from_scan(scan(three_tubes(), known.support.bin, known.camera), CloudOf::tubes, 3);
    std::vector<SegmentTree> tubes = {known.kinds[0].segments};
    if (GetParam() != Method::paper) tubes.push_back({{1, 4, 0.2}, {4, 2, 0.2}, {4, 3, 0.1}});
    for (const SegmentTree& segments : tubes) {
      known.kinds[0].segments = segments;
      const Model model = modelled(cloud, known, settings);
      EXPECT_EQ(model.labels.size(), cloud.points.size());
      for (const Tube& tube : model.tubes) {
        for (const auto& node : tube.nodes) EXPECT_TRUE(node.position.allFinite());
      }
    }
  }
};

INSTANTIATE_TEST_SUITE_P(By, UnusualParameters, testing::ValuesIn(methods()),
                         [](const auto& method) { return name_of(method.param); });

TEST_P(UnusualParameters, AtEitherBoundStillGiveAModel) {
  for (const Parameter& parameter : of_method()) {
    for (const double value : {parameter.bounds.least, parameter.bounds.greatest}) {
      SCOPED_TRACE(parameter.name);
      ModelSettings settings;
      set_parameter(settings, parameter.name, value);
      expect_model(settings);
    }
  }
}

TEST_P(UnusualParameters, TogetherStillGiveAModel) {
  std::mt19937 random;
  const std::vector<Parameter> all = of_method();
  for (int i = 0; i < 60; ++i) {
    ModelSettings settings;
    for (const auto& [name, meaning, standard, is_whole, bounds, range] : all) {
      // At a bound, not far from the default, or the default.
      const std::array values = {bounds.least, bounds.greatest, 0.5 * standard,
                                 2 * standard, standard,        standard};
      const double value = std::clamp(values.at(random() % values.size()), bounds.least, bounds.greatest);
      set_parameter(settings, name, is_whole ? std::ceil(value) : value);
    }
    SCOPED_TRACE(testing::PrintToString(changed_parameters(settings)));
    expect_model(settings);
  }
}

TEST(PaperMethod, KnowsOneRadiusOnly) {
  KnownScene scene = paper_scene();
  scene.kinds.push_back({.radius = 0.008});
  EXPECT_EQ(test::complaint([&] { model_tubes({}, scene, {.method = Method::paper}); }),
            "method: the paper's method handles a single radius; use --method axis");
}

TEST(Methods, HaveNamesBothWays) {
  for (const Method method : methods()) EXPECT_EQ(method_named(name_of(method)), method);
  EXPECT_THROW(method_named("magic"), InputError);
}

}  // namespace
}  // namespace tanglebin
