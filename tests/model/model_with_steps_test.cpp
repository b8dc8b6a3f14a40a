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

TEST(ModelWithSteps, IsTheModelAndWhatItWasMadeOf) {
  const RaisedScene scene;
  const ModelWithSteps modelled = model_with_steps(scene.cloud, scene.known);
  const Model model = model_tubes(scene.cloud, scene.known);
  EXPECT_EQ(modelled.model.labels, model.labels);
  EXPECT_EQ(modelled.model.tubes.size(), model.tubes.size());
  ASSERT_TRUE(std::holds_alternative<AxisModel>(modelled.steps));
  const auto& [of_steps, kinds] = std::get<AxisModel>(modelled.steps);
  ASSERT_EQ(kinds.size(), 1U);
  EXPECT_FALSE(kinds[0].fragments.empty());
  EXPECT_EQ(of_steps.labels, model.labels);
}

TEST(ModelWithSteps, StepsAreInTheSupportsFrame) {
  const RaisedScene scene;
  const auto [model, seen, steps] = model_with_steps(scene.cloud, scene.known);
  EXPECT_TRUE(seen.known.support.pose.isApprox(Eigen::Isometry3d::Identity()));
  const Tube& in_world = model.tubes.at(0);
  const Tube& in_support = std::get<AxisModel>(steps).model.tubes.at(0);
  EXPECT_NEAR(in_world.nodes[0].position.z() - in_support.nodes[0].position.z(), 0.001, 1e-9);
}

}  // namespace
}  // namespace tanglebin
