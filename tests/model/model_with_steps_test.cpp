#include "tanglebin/model/model_with_steps.hpp"

#include <gtest/gtest.h>

#include <variant>
#include <vector>

#include "tests/model/scene/scanned.hpp"

namespace tanglebin {
namespace {

// A tube on the floor of a bin that stands a millimetre high.
struct RaisedScene {
  std::vector<Tube> tubes{test::chain(1, 0.0125, {{-0.2, 0, 0.0125}, {0, 0.02, 0.0125}, {0.2, 0, 0.0125}})};
  KnownScene known = test::paper_scene();
  PointCloud cloud = test::scanned(tubes);

  RaisedScene() { known.support.pose = Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.001)); }
};

TEST(ModelWithSteps, IsTheModelAndShowsWhatItWasMadeOf) {
  const RaisedScene scene;
  AxisModel shown;
  const Model with_steps = model_with_steps(
      scene.cloud, scene.known, {}, [&](const MethodRun& run) { shown = std::get<AxisModel>(run.steps); });
  const Model model = model_tubes(scene.cloud, scene.known);
  EXPECT_EQ(with_steps.labels, model.labels);
  EXPECT_EQ(with_steps.tubes.size(), model.tubes.size());
  ASSERT_EQ(shown.kinds.size(), 1U);
  EXPECT_FALSE(shown.kinds[0].fragments.empty());
  EXPECT_EQ(shown.model.labels, model.labels);
}

TEST(ModelWithSteps, StepsAreInTheSupportsFrame) {
  const RaisedScene scene;
  Tube in_support;
  const Model model = model_with_steps(scene.cloud, scene.known, {}, [&](const MethodRun& run) {
    EXPECT_TRUE(run.known.support.pose.isApprox(Eigen::Isometry3d::Identity()));
    in_support = std::get<AxisModel>(run.steps).model.tubes.at(0);
  });
  EXPECT_NEAR(model.tubes.at(0).nodes[0].position.z() - in_support.nodes[0].position.z(), 0.001, 1e-9);
}

}  // namespace
}  // namespace tanglebin
