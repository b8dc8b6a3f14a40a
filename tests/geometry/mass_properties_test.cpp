#include "tanglebin/geometry/mass_properties.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "tanglebin/generate/generate.hpp"
#include "tests/geometry/example_tubes.hpp"

namespace tanglebin {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using std::numbers::pi;
using test::radians;
using test::rounding;

constexpr double r = 0.0125;

// Two cylinders of 50 and 40 mm that bend into each other towards an azimuth.
Tube bent_tube(double bend, double azimuth = 0) {
  const Vector3d second(std::sin(bend) * std::cos(azimuth), std::sin(bend) * std::sin(azimuth),
                        std::cos(bend));
  return test::tube_through({{0, 0, 0}, {0, 0, 0.05}, Vector3d(0, 0, 0.05) + 0.04 * second});
}

double difference(const Matrix3d& found, const Matrix3d& expected) {
  return (found - expected).norm() / expected.norm();
}

Tube reversed(Tube tube) {
  std::vector<Vector3d> points;
  for (auto node = tube.nodes.rbegin(); node != tube.nodes.rend(); ++node) points.push_back(node->position);
  return test::tube_through(points);
}

// A reference that shares nothing with the quadrature: points spread evenly over each capsule's bounding
// cylinder (the R3 sequence of M. Roberts), each counted once in the union.
MassProperties sampled_mass_properties(const Tube& tube) {
  constexpr int samples = 50000;
  const Vector3d step(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
  const std::vector<Capsule> all = capsules(tube);
  double volume = 0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto [centre, rotation, length] = frame_of(tube, tube.edges[k]);
    std::vector<Capsule> near;  // the capsule itself and those that may share its points
    std::ranges::copy_if(all, std::back_inserter(near),
                         [&](const Capsule& other) { return surface_distance(other, all[k]) <= 0; });
    const double height = length + 2 * tube.radius;
    const double sample_volume = pi * tube.radius * tube.radius * height / samples;
    for (int i = 0; i < samples; ++i) {
      const Vector3d fraction = (step * i).unaryExpr([](double x) { return x - std::floor(x); });
      const double rho = tube.radius * std::sqrt(fraction.x());
      const double phi = 2 * pi * fraction.y();
      const double along = (fraction.z() - 0.5) * height;
      const Vector3d point = centre + rotation * Vector3d(rho * std::cos(phi), rho * std::sin(phi), along);
      const auto holds_point = [&](const Capsule& capsule) {
        return closest_points(point, point, capsule.a, capsule.b).distance <= capsule.radius;
      };
      if (!holds_point(all[k])) continue;
      const double share = sample_volume / static_cast<double>(std::ranges::count_if(near, holds_point));
      volume += share;
      first += share * point;
      second += share * point * point.transpose();
    }
  }
  const Vector3d centre = first / volume;
  const Matrix3d spread = second / volume - centre * centre.transpose();
  return {tube.mass, volume, centre, tube.mass * (spread.trace() * Matrix3d::Identity() - spread)};
}

TEST(MassProperties, OfOneCapsuleAreThoseOfTheClosedForm) {
  for (const double length : {0.001, 0.02, 0.3}) {
    const MassProperties found = mass_properties(test::tube_through({{0, 0, 0}, {length, 0, 0}}));

    const double volume = pi * r * r * length + 4.0 / 3 * pi * r * r * r;
    EXPECT_NEAR(found.volume / volume, 1, rounding);
    EXPECT_EQ(found.mass, 0.5);
    EXPECT_TRUE(found.centre.isApprox(Vector3d(length / 2, 0, 0), rounding));

    const double cylinder = found.mass * pi * r * r * length / volume;
    const double caps = found.mass - cylinder;
    const double along = cylinder * r * r / 2 + caps * 2 / 5 * r * r;
    const double across = cylinder * (length * length / 12 + r * r / 4) +
                          caps * (2.0 / 5 * r * r + length * length / 4 + 3.0 / 8 * length * r);
    const Matrix3d expected = Vector3d(along, across, across).asDiagonal();
    EXPECT_LT(difference(found.inertia, expected), rounding);
  }
}

TEST(MassProperties, OfOneCylinderWithFlatEndsAreThoseOfTheClosedForm) {
  for (const double length : {0.001, 0.02, 0.3}) {
    Tube tube = test::tube_through({{0, 0, 0}, {length, 0, 0}});
    tube.flat_ends = true;
    const MassProperties found = mass_properties(tube);
    EXPECT_NEAR(found.volume / (pi * r * r * length), 1, rounding);
    EXPECT_TRUE(found.centre.isApprox(Vector3d(length / 2, 0, 0), rounding));
    const double across = length * length / 12 + r * r / 4;
    const Matrix3d expected = found.mass * Vector3d(r * r / 2, across, across).asDiagonal();
    EXPECT_LT(difference(found.inertia, expected), rounding);
  }
}

TEST(MassProperties, FlatEndsTakeTwoHemispheresFromABentTube) {
  Tube tube = bent_tube(radians(60));
  const double round = mass_properties(tube).volume;
  tube.flat_ends = true;
  EXPECT_NEAR((round - mass_properties(tube).volume) / (4.0 / 3 * pi * r * r * r), 1, 1e-9);
}

// Each cylinder lacks a hoof (ungula) beyond the mitre plane, ⅔ r³ tan(θ/2), on the inside of the bend, and
// the joint's sphere adds a lune, ⅔ r³ θ, on the outside.
TEST(MassProperties, OfABentJointHaveTheVolumeOfTheClosedForm) {
  for (double bend_deg = 0; bend_deg <= 120; bend_deg += 2.5) {
    const double bend = radians(bend_deg);
    const double volume =
        pi * r * r * 0.09 + 4.0 / 3 * pi * r * r * r + 2.0 / 3 * r * r * r * (bend - 2 * std::tan(bend / 2));
    for (double azimuth = 0; azimuth < 2 * pi; azimuth += 0.1) {
      EXPECT_NEAR(mass_properties(bent_tube(bend, azimuth)).volume / volume, 1, 1e-5) << bend_deg << "°";
    }
  }
}

// Within 0.1 % and 0.2 mm, most of which is left to the reference's own error.
TEST(MassProperties, OfDrawnTubesAreThoseOfSampledPoints) {
  Rng rng(1);
  for (const TubeSpec& spec :
       {test::chain_spec(30), test::chain_spec(45), test::chain_spec(120), test::tree_spec()}) {
    const Tube tube = draw_tube(rng, spec, 1);
    const MassProperties found = mass_properties(tube);
    const MassProperties expected = sampled_mass_properties(tube);
    EXPECT_NEAR(found.volume / expected.volume, 1, 0.001);
    EXPECT_LT((found.centre - expected.centre).norm(), 0.0002);
    EXPECT_LT(difference(found.inertia, expected.inertia), 0.001);
  }
}

TEST(MassProperties, CountSharedSpaceOnce) {
  const Tube once = test::tube_through({{0, 0, 0}, {0, 0.1, 0}, {0, 0.2, 0.1}});
  Tube twice = once;
  test::add_branch(twice, 0, {{0, 0.1, 0}, {0, 0.2, 0.1}});
  EXPECT_NEAR(mass_properties(twice).volume / mass_properties(once).volume, 1, rounding);
  EXPECT_LT(difference(mass_properties(twice).inertia, mass_properties(once).inertia), rounding);
}

// As exactly as the quadrature, which begins at another place around each cylinder.
RC_GTEST_PROP(MassProperties, MoveWithTheTube, (std::uint64_t seed)) {
  Rng rng(seed);
  Tube tube = draw_tube(rng, test::chain_spec(45), 1);
  const MassProperties before = mass_properties(tube);
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(1, -2, 3) * Eigen::AngleAxisd(uniform_real(rng, 0, pi), Vector3d(1, 2, 2) / 3);
  transform(tube, motion);
  const MassProperties after = mass_properties(tube);
  RC_ASSERT(std::abs(after.volume / before.volume - 1) < 1e-5);
  RC_ASSERT((after.centre - motion * before.centre).norm() < 1e-6);
  const Matrix3d turned = motion.linear() * before.inertia * motion.linear().transpose();
  RC_ASSERT(difference(after.inertia, turned) < 1e-5);
}

RC_GTEST_PROP(MassProperties, DoNotDependOnWhichEndIsFirst, (std::uint64_t seed)) {
  Rng rng(seed);
  const Tube tube = draw_tube(rng, test::chain_spec(45), 1);
  const MassProperties forward = mass_properties(tube);
  const MassProperties backward = mass_properties(reversed(tube));
  RC_ASSERT(std::abs(backward.volume / forward.volume - 1) < 1e-5);
  RC_ASSERT((backward.centre - forward.centre).norm() < 1e-6);
  RC_ASSERT(difference(backward.inertia, forward.inertia) < 1e-5);
}

TEST(MassProperties, DoNotDependOnHowAStraightCylinderIsSplit) {
  const Vector3d a(0.1, 0.2, 0.3);
  const Vector3d b(0.3, -0.1, 0.25);
  const MassProperties whole = mass_properties(test::tube_through({a, b}));
  const MassProperties split =
      mass_properties(test::tube_through({a, a + 0.1 * (b - a), a + 0.15 * (b - a), b}));
  EXPECT_NEAR(split.volume / whole.volume, 1, 1e-9);
  EXPECT_LT((split.centre - whole.centre).norm(), 1e-9);
  EXPECT_LT(difference(split.inertia, whole.inertia), 1e-9);
}

TEST(MassProperties, ChangeLittleWhereABendChangesLittle) {
  constexpr double little = 1e-7;
  for (double bend_deg = 0; bend_deg <= 150; bend_deg += 0.5) {
    const MassProperties before = mass_properties(bent_tube(radians(bend_deg), 0.3));
    const MassProperties after = mass_properties(bent_tube(radians(bend_deg) + little, 0.3));
    EXPECT_LT(std::abs(after.volume / before.volume - 1), 2 * little) << bend_deg << "°";
    EXPECT_LT(difference(after.inertia, before.inertia), 2 * little) << bend_deg << "°";
  }
}

// Positive moments of which none exceeds the sum of the others, as every real body has.
RC_GTEST_PROP(MassProperties, AreThoseOfARealBody, (std::uint64_t seed)) {
  Rng rng(seed);
  const Tube tube =
      draw_tube(rng, *rc::gen::arbitrary<bool>() ? test::tree_spec() : test::chain_spec(150), 1);
  const MassProperties found = mass_properties(tube);
  RC_ASSERT(found.inertia == found.inertia.transpose());
  const Vector3d moments = Eigen::SelfAdjointEigenSolver<Matrix3d>(found.inertia).eigenvalues();
  RC_ASSERT(moments[0] >= 0.5 * found.mass * r * r * 0.8);  // no less than about a thin straight tube's
  RC_ASSERT(moments[0] + moments[1] > moments[2]);
  RC_ASSERT(bounds(tube).contains(found.centre));
}

}  // namespace
}  // namespace tanglebin
