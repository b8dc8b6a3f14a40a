#include "tanglebin/scan/capsule_index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tanglebin/geometry/intersect.hpp"
#include "tests/scan/scene.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::random_direction;
using test::random_point;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::size_t> candidates(const CapsuleIndex& index, const Vector3d& direction) {
  std::vector<std::size_t> found;
  index.candidates(direction, found);
  return found;
}

/// A ray of the beam: it deviates from the central direction by `spread` at most.
Ray ray_of(const BeamShape& beam, const Vector3d& central, double deviation) {
  return {beam.origin, std::sqrt(1 - deviation * deviation) * central + deviation * central.unitOrthogonal()};
}

/// Every capsule that a ray through its inside, up to its very surface, meets must be a candidate of a beam
/// that holds the ray.
void expect_no_capsule_missed(Rng& rng, const std::vector<Capsule>& capsules, const BeamShape& beam) {
  const CapsuleIndex index(capsules, beam);
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    const Vector3d on_axis = capsules[i].a + uniform_real(rng, 0, 1) * (capsules[i].b - capsules[i].a);
    const Vector3d aim = on_axis + capsules[i].radius * random_direction(rng);
    const Vector3d central = (aim - beam.origin).normalized();
    const Ray ray = ray_of(beam, central, uniform_real(rng, -beam.spread, beam.spread));
    const auto found = candidates(index, central);
    for (std::size_t other = 0; other < capsules.size(); ++other) {
      if (!ray_capsule(ray, capsules[other])) continue;
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), other))
          << "capsule " << other << " of radius " << capsules[other].radius << " from "
          << capsules[other].a.transpose() << " to " << capsules[other].b.transpose()
          << " missed by the ray from " << ray.origin.transpose() << " along " << ray.direction.transpose();
    }
  }
}

std::vector<Capsule> random_capsules(Rng& rng, int count, const Vector3d& centre, double longest) {
  std::vector<Capsule> capsules;
  for (int i = 0; i < count; ++i) {
    const Vector3d a = centre + random_point(rng, {Vector3d::Constant(-0.3), Vector3d::Constant(0.3)});
    const double length = longest * std::pow(10, uniform_real(rng, -4, 0));
    capsules.push_back({a, a + length * random_direction(rng), std::pow(10, uniform_real(rng, -3.5, -1.5))});
  }
  return capsules;
}

TEST(CapsuleIndex, TellsThePilesCapsulesApart) {
  const std::vector<Capsule> row = {{Vector3d(0, 0, 0), Vector3d(0, 1, 0), 0.01},
                                    {Vector3d(1, 0, 0), Vector3d(1, 1, 0), 0.01},
                                    {Vector3d(1, 0, -1), Vector3d(1, 1, -1), 0.01}};
  const CapsuleIndex index(row, {Vector3d(0.5, 0.5, 2), 0.001});
  EXPECT_THAT(candidates(index, Vector3d(-0.5, 0, -2).normalized()), ElementsAre(0));
  EXPECT_THAT(candidates(index, Vector3d(0.5, 0, -2).normalized()), ElementsAre(1));
  EXPECT_THAT(candidates(index, Vector3d(0.5, 0, -3).normalized()), ElementsAre(2));
  EXPECT_THAT(candidates(index, Vector3d(0, 0, -1)), IsEmpty());
  EXPECT_THAT(candidates(index, Vector3d(0, 0, 1)), IsEmpty());
}

TEST(CapsuleIndex, FindsAllCapsulesOneBehindTheOther) {
  std::vector<Capsule> stack;
  for (int i = 0; i < 50; ++i) stack.push_back({Vector3d(-1, 0, -0.01 * i), Vector3d(1, 0, -0.01 * i), 0.02});
  const CapsuleIndex index(stack, {Vector3d(0, 0, 1), 0});
  EXPECT_EQ(candidates(index, Vector3d(0, 0, -1)).size(), stack.size());
}

TEST(CapsuleIndex, OfNoCapsulesHasNoCandidates) {
  const CapsuleIndex index({}, {Vector3d::Zero(), 0.01});
  EXPECT_THAT(candidates(index, Vector3d::UnitX()), IsEmpty());
}

TEST(CapsuleIndex, FindsCapsulesSeenExactlyAlongTheirAxis) {
  const CapsuleIndex index({{Vector3d(0, 0, 0), Vector3d(0, 0, 0.3), 0.01}}, {Vector3d(0.009, 0, 2), 0});
  EXPECT_THAT(candidates(index, Vector3d(0, 0, -1)), ElementsAre(0));
}

TEST(CapsuleIndex, FindsSpheres) {
  const CapsuleIndex index({{Vector3d(1, 0, 0), Vector3d(1, 0, 0), 0.01}}, {Vector3d(1, 0.009, 2), 0});
  EXPECT_THAT(candidates(index, Vector3d(0, 0, -1)), ElementsAre(0));
}

RC_GTEST_PROP(CapsuleIndex, MissesNoCapsule, (std::uint64_t seed)) {
  SCOPED_TRACE(seed);
  Rng rng(seed);
  const Vector3d eye = uniform_real(rng, 0, 3) * random_direction(rng);
  const double spread = uniform_integer(rng, 0, 1) == 0 ? 0 : uniform_real(rng, 0, 0.25);
  expect_no_capsule_missed(rng, random_capsules(rng, 50, Vector3d::Zero(), 0.5), {eye, spread});
}

RC_GTEST_PROP(CapsuleIndex, MissesNoLongThinCapsule, (std::uint64_t seed)) {
  SCOPED_TRACE(seed);
  Rng rng(seed);
  std::vector<Capsule> capsules = random_capsules(rng, 50, Vector3d::Zero(), 3);
  for (Capsule& capsule : capsules) capsule.radius = 0.0005;
  expect_no_capsule_missed(rng, capsules, {4 * random_direction(rng), 0});
}

RC_GTEST_PROP(CapsuleIndex, MissesNoCapsuleNearlyAlongItsAxis, (std::uint64_t seed)) {
  SCOPED_TRACE(seed);
  Rng rng(seed);
  std::vector<Capsule> capsules = random_capsules(rng, 50, Vector3d::Zero(), 0.5);
  const Vector3d eye = 2 * random_direction(rng);
  for (Capsule& capsule : capsules) {
    const double deviation = std::pow(10, uniform_real(rng, -9, -1));
    const Vector3d axis = ((capsule.a - eye).normalized() + deviation * random_direction(rng)).normalized();
    capsule.b = capsule.a + (capsule.b - capsule.a).norm() * axis;
  }
  expect_no_capsule_missed(rng, capsules, {eye, 0});
}

RC_GTEST_PROP(CapsuleIndex, MissesNoCapsuleFarFromTheWorldsOrigin, (std::uint64_t seed)) {
  SCOPED_TRACE(seed);
  Rng rng(seed);
  const Vector3d centre(1000, -2000, 500);
  expect_no_capsule_missed(rng, random_capsules(rng, 50, centre, 0.5),
                           {centre + 2 * random_direction(rng), 0});
}

RC_GTEST_PROP(CapsuleIndex, MissesNoCapsuleFarFromTheEye, (std::uint64_t seed)) {
  SCOPED_TRACE(seed);
  Rng rng(seed);
  const auto capsules = random_capsules(rng, 50, Vector3d::Zero(), 0.5);
  expect_no_capsule_missed(rng, capsules, {1000 * random_direction(rng), 0});
}

}  // namespace
}  // namespace tanglebin
