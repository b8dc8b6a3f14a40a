#include "tanglebin/simulate/world_sdf.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <sdf/sdf.hh>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/cloud/label_colors.hpp"
#include "tanglebin/generate/generate.hpp"
#include "tanglebin/geometry/mass_properties.hpp"

namespace tanglebin {
namespace {

using testing::HasSubstr;

// Tubes like those of the published sets A and C.

TubeSpec chain_spec() {
  TubeSpec spec;
  spec.segments.front().bend_max = std::numbers::pi / 6;
  return spec;
}

TubeSpec tree_spec() {
  const double bend_max = std::numbers::pi / 9;
  TubeSpec spec;
  spec.mass = 0.75;
  spec.segments = {{{1, 2, 0.30}, 5, 10, 0.02, 0, bend_max},
                   {{1, 3, 0.10}, 2, 5, 0.02, 0, bend_max},
                   {{1, 4, 0.10}, 2, 5, 0.02, 0, bend_max},
                   {{2, 5, 0.10}, 2, 5, 0.02, 0, bend_max},
                   {{2, 6, 0.15}, 2, 6, 0.02, 0, bend_max}};
  return spec;
}

std::vector<Tube> draw_tubes(const TubeSpec& spec, int count) {
  Rng rng(7);
  std::vector<Tube> tubes;
  for (int id = 1; id <= count; ++id) {
    tubes.push_back(draw_tube(rng, spec, id));
    Eigen::Isometry3d motion(Eigen::AngleAxisd(0.7 * id, Eigen::Vector3d(1, id, -2).normalized()));
    motion.translation() = Eigen::Vector3d(0.01 * id, -0.02 * id, 0.1);
    transform(tubes.back(), motion);
  }
  return tubes;
}

/// A tube of one cylinder between two points.
Tube straight_tube(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Tube tube;
  tube.radius = 0.0125;
  tube.mass = 0.5;
  tube.nodes = {{1, from}, {2, to}};
  tube.edges = {{0, 1, 1}};
  return tube;
}

std::string world_text(const std::vector<Tube>& tubes, const Bin& bin, const Camera& camera,
                       const SettleSettings& settings = {}) {
  std::ostringstream out;
  write_world(out, tubes, bin, camera, settings);
  return out.str();
}

std::string world_text(const std::vector<Tube>& tubes) {
  return world_text(tubes, bin_preset("paper"), camera_preset("paper"));
}

/// Loads a world as strictly as libsdformat can; expects no error, no warning and nothing on the console.
sdf::Root load(const std::string& text) {
  sdf::ParserConfig strict;
  strict.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  strict.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  strict.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::ERR);
  sdf::Root root;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const sdf::Errors errors = root.LoadSdfString(text, strict);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  for (const sdf::Error& error : errors) ADD_FAILURE() << error;
  EXPECT_EQ(root.WorldCount(), 1U);
  return root;
}

const sdf::Link& only_link(const sdf::World& world, const std::string& model) {
  EXPECT_NE(world.ModelByName(model), nullptr) << model;
  EXPECT_EQ(world.ModelByName(model)->LinkCount(), 1U);
  return *world.ModelByName(model)->LinkByIndex(0);
}

Eigen::Isometry3d isometry(const ignition::math::Pose3d& pose) {
  const auto& p = pose.Pos();
  const auto& q = pose.Rot();
  return Eigen::Translation3d(p.X(), p.Y(), p.Z()) * Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z());
}

/// Frame of a model's link, or of what is in it, → world frame.
template <typename Part>
Eigen::Isometry3d pose_in_world(const sdf::World& world, const std::string& model, const Part& part) {
  const sdf::Model& parent = *world.ModelByName(model);
  return isometry(parent.RawPose()) * isometry(parent.LinkByIndex(0)->RawPose()) * isometry(part.RawPose());
}

/// A coefficient of a collision, mu or mu2; libsdformat 12 has no class for them.
double friction(const sdf::Collision& collision, const std::string& coefficient) {
  sdf::ElementPtr element = collision.Element();
  for (const char* tag : {"surface", "friction", "ode"}) element = element->GetElement(tag);
  return element->Get<double>(coefficient);
}

Eigen::Matrix3d matrix(const ignition::math::Matrix3d& m) {
  Eigen::Matrix3d result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      result(row, column) = m(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
    }
  }
  return result;
}

/// Every edge a cylinder and every node a sphere, in place, both to be hit and to be seen; nothing else.
void expect_shape_of(const Tube& tube, const sdf::World& world) {
  const std::string model = "tube_" + std::to_string(tube.id);
  const sdf::Link& link = only_link(world, model);
  ASSERT_EQ(link.CollisionCount(), tube.edges.size() + tube.nodes.size());
  ASSERT_EQ(link.VisualCount(), tube.edges.size() + tube.nodes.size());
  for (const Edge& edge : tube.edges) {
    const auto [centre, rotation, length] = frame_of(tube, edge);
    const std::string name =
        "e_" + std::to_string(tube.nodes[edge.from].id) + "_" + std::to_string(tube.nodes[edge.to].id);
    const sdf::Collision* collision = link.CollisionByName(name + "_collision");
    const sdf::Visual* visual = link.VisualByName(name + "_visual");
    ASSERT_TRUE(collision != nullptr && visual != nullptr) << name;
    const Eigen::Isometry3d pose = pose_in_world(world, model, *collision);
    EXPECT_TRUE(pose.translation().isApprox(centre, 1e-12)) << name;
    EXPECT_TRUE(pose.linear().isApprox(rotation.toRotationMatrix(), 1e-12)) << name;
    EXPECT_TRUE(pose.isApprox(pose_in_world(world, model, *visual))) << name;
    EXPECT_EQ(collision->Geom()->CylinderShape()->Length(), length);
    EXPECT_EQ(collision->Geom()->CylinderShape()->Radius(), tube.radius);
    EXPECT_EQ(visual->Geom()->CylinderShape()->Length(), length);
  }
  for (const Node& node : tube.nodes) {
    const std::string name = "n_" + std::to_string(node.id);
    const sdf::Collision* collision = link.CollisionByName(name + "_collision");
    ASSERT_TRUE(collision != nullptr && link.VisualByName(name + "_visual") != nullptr) << name;
    const Eigen::Vector3d centre = pose_in_world(world, model, *collision).translation();
    EXPECT_TRUE(centre.isApprox(node.position, 1e-12)) << name;
    EXPECT_EQ(collision->Geom()->SphereShape()->Radius(), tube.radius);
  }
}

void expect_inertia_of(const Tube& tube, const sdf::World& world) {
  const std::string model = "tube_" + std::to_string(tube.id);
  const sdf::Link& link = only_link(world, model);
  const ignition::math::Inertiald inertial = link.Inertial();
  EXPECT_TRUE(inertial.MassMatrix().IsPositive());
  EXPECT_TRUE(inertial.MassMatrix().IsValid());
  const MassProperties expected = mass_properties(tube);
  EXPECT_EQ(inertial.MassMatrix().Mass(), tube.mass);
  const Eigen::Isometry3d link_pose = pose_in_world(world, model, sdf::Link{});
  EXPECT_TRUE((link_pose * isometry(inertial.Pose())).translation().isApprox(expected.centre, 1e-12));
  EXPECT_TRUE(link_pose.linear().isIdentity());
  EXPECT_TRUE(matrix(inertial.Moi()).isApprox(expected.inertia, 1e-12));
}

void expect_world_of(const std::vector<Tube>& tubes) {
  const sdf::Root root = load(world_text(tubes));
  const sdf::World& world = *root.WorldByIndex(0);
  EXPECT_EQ(world.ModelCount(), tubes.size() + 2);  // and the bin and the scanner
  for (const Tube& tube : tubes) {
    SCOPED_TRACE(tube.id);
    expect_shape_of(tube, world);
    expect_inertia_of(tube, world);
  }
}

TEST(WorldSdf, ChainsAreRigidModelsOfCylindersAndSpheres) {
  expect_world_of(draw_tubes(chain_spec(), 10));
}

TEST(WorldSdf, TreesAreRigidModelsOfCylindersAndSpheres) {
  expect_world_of(draw_tubes(tree_spec(), 5));
}

// Where pitch is ±90°, roll and yaw turn about the same axis.
TEST(WorldSdf, AFlatEndHasNoSphere) {
  Tube tube = straight_tube({0, 0, 0.1}, {0.2, 0, 0.1});
  const auto solids = [&] {
    return only_link(*load(world_text({tube})).WorldByIndex(0), "tube_1").CollisionCount();
  };
  EXPECT_EQ(solids(), 3U);
  tube.flat_ends = true;
  EXPECT_EQ(solids(), 1U);
}

TEST(WorldSdf, TubesAlongEveryAxisKeepTheirDirection) {
  const Eigen::Vector3d from(0.1, -0.05, 0.03);
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, 1, 0),
        Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1),
        Eigen::Vector3d(1, 1e-9, 1e-9)}) {
    SCOPED_TRACE(axis.transpose());
    expect_world_of({straight_tube(from, from + 0.5 * axis)});
  }
}

TEST(WorldSdf, AnEmptyBinIsAWorldToo) {
  expect_world_of({});
}

TEST(WorldSdf, TheBinIsStaticAndMadeOfItsBoxes) {
  const Bin bin = bin_preset("published");
  const sdf::Root root = load(world_text({}, bin, camera_preset("paper")));
  const sdf::World& world = *root.WorldByIndex(0);
  const sdf::Link& link = only_link(world, "bin");
  EXPECT_TRUE(world.ModelByName("bin")->Static());
  ASSERT_EQ(link.CollisionCount(), 5U);
  ASSERT_EQ(link.VisualCount(), 5U);
  const auto sides = boxes(bin);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const sdf::Collision& collision = *link.CollisionByIndex(i);
    const auto size = collision.Geom()->BoxShape()->Size();
    EXPECT_TRUE(pose_in_world(world, "bin", collision).translation().isApprox(sides.at(i).center(), 1e-12));
    EXPECT_TRUE(Eigen::Vector3d(size.X(), size.Y(), size.Z()).isApprox(sides.at(i).sizes(), 1e-12));
    EXPECT_EQ(friction(collision, "mu"), bin.friction);
  }
}

TEST(WorldSdf, TubesHaveTheirFrictionAndTheColoursOfTheirLabels) {
  const std::vector<Tube> tubes = draw_tubes(chain_spec(), 3);
  const sdf::Root root = load(world_text(tubes));
  const std::vector<Color> colors = label_colors(3);
  for (const Tube& tube : tubes) {
    const sdf::Link& link = only_link(*root.WorldByIndex(0), "tube_" + std::to_string(tube.id));
    EXPECT_EQ(friction(*link.CollisionByIndex(0), "mu"), SettleSettings{}.friction);
    EXPECT_EQ(friction(*link.CollisionByIndex(0), "mu2"), SettleSettings{}.friction);
    const Color expected = colors.at(static_cast<std::size_t>(tube.id));
    const ignition::math::Color color = link.VisualByIndex(0)->Material()->Diffuse();
    EXPECT_EQ(std::lround(color.R() * 255), expected[0]);
    EXPECT_EQ(std::lround(color.G() * 255), expected[1]);
    EXPECT_EQ(std::lround(color.B() * 255), expected[2]);
  }
}

TEST(WorldSdf, TheCameraLooksWhereOursLooks) {
  Camera camera = camera_preset("paper");
  camera.pose.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()));
  const sdf::Root root = load(world_text({}, bin_preset("paper"), camera));
  const sdf::World& world = *root.WorldByIndex(0);
  const sdf::Sensor& sensor = *only_link(world, "scanner").SensorByIndex(0);
  ASSERT_EQ(sensor.Type(), sdf::SensorType::DEPTH_CAMERA);

  const Eigen::Isometry3d pose = pose_in_world(world, "scanner", sensor);
  EXPECT_TRUE(pose.translation().isApprox(camera.pose.translation(), 1e-12));
  const Eigen::Matrix3d optical = camera.pose.linear();
  EXPECT_TRUE(pose.linear().col(0).isApprox(optical.col(2), 1e-12));   // forward
  EXPECT_TRUE(pose.linear().col(1).isApprox(-optical.col(0), 1e-12));  // left
  EXPECT_TRUE(pose.linear().col(2).isApprox(-optical.col(1), 1e-12));  // up

  const sdf::Camera& image = *sensor.CameraSensor();
  EXPECT_NEAR(image.HorizontalFov().Radian(), 1.22, 1e-12);  // that of the published worlds
  EXPECT_EQ(image.ImageWidth(), 1920U);
  EXPECT_EQ(image.ImageHeight(), 1200U);
  EXPECT_LT(image.NearClip(), 1.7);  // the rim is 1.8 m away
  EXPECT_GT(image.FarClip(), 2.1);   // the floor's corners 2.03 m
}

TEST(WorldSdf, PhysicsIsThatOfTheSettling) {
  SettleSettings settings;
  settings.gravity = 1.62;
  settings.step = 0.004;
  settings.sor = 1.1;
  settings.surface_layer = 0.0003;
  const sdf::Root root = load(world_text({}, bin_preset("paper"), camera_preset("paper"), settings));
  const sdf::World& world = *root.WorldByIndex(0);
  EXPECT_EQ(world.Gravity(), ignition::math::Vector3d(0, 0, -1.62));
  ASSERT_EQ(world.PhysicsCount(), 1U);
  EXPECT_EQ(world.PhysicsByIndex(0)->EngineType(), "ode");
  EXPECT_EQ(world.PhysicsByIndex(0)->MaxStepSize(), 0.004);
  const sdf::ElementPtr ode = world.PhysicsByIndex(0)->Element()->GetElement("ode");
  EXPECT_EQ(ode->GetElement("solver")->Get<double>("sor"), 1.1);
  EXPECT_EQ(ode->GetElement("solver")->Get<int>("iters"), settings.iterations_max);
  EXPECT_EQ(ode->GetElement("constraints")->Get<double>("contact_surface_layer"), 0.0003);
}

TEST(WorldSdf, ATubeOfUnknownMassWeighsAKilogramAMetre) {
  std::vector<Tube> tubes = draw_tubes(tree_spec(), 1);
  tubes.front().mass = 0;
  const sdf::Root root = load(world_text(tubes));
  const ignition::math::MassMatrix3d mass =
      only_link(*root.WorldByIndex(0), "tube_1").Inertial().MassMatrix();
  EXPECT_NEAR(mass.Mass(), 0.75, 1e-9);  // what the published tube of this length weighs
  EXPECT_TRUE(mass.IsValid());
}

TEST(WorldSdf, HugeAndTinyScenesLoad) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    SCOPED_TRACE(scale);
    const Bin bin{scale, scale, scale, 0.1 * scale, 1e9};
    Tube tube = straight_tube({0, 0, 0.1 * scale}, {0.3 * scale, 0.2 * scale, 0.1 * scale});
    tube.id = 60000;
    tube.radius = 0.01 * scale;
    tube.mass = 1000 * scale * scale * scale;
    tube.nodes[0].id = 2147483647;
    const Camera camera = downward_camera(100000, 1, 1e3, {0, 0, 2 * scale});
    const sdf::Root root = load(world_text({tube}, bin, camera));
    EXPECT_TRUE(only_link(*root.WorldByIndex(0), "tube_60000").Inertial().MassMatrix().IsPositive());
  }
}

TEST(WorldSdf, ACameraTooNarrowForSdfIsRefused) {
  const Camera camera = downward_camera(1920, 1200, 20000, {0, 0, 20});
  try {
    world_text({}, bin_preset("paper"), camera);
    FAIL() << "0.096 rad were accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("scanner"));
    EXPECT_THAT(error.what(), HasSubstr("0.0959"));
  }
}

TEST(WorldSdf, TheSameTubesGiveTheSameBytes) {
  EXPECT_EQ(world_text(draw_tubes(tree_spec(), 4)), world_text(draw_tubes(tree_spec(), 4)));
}

}  // namespace
}  // namespace tanglebin
