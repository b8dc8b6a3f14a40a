#include "tanglebin/geometry/intersect.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>

#include "tests/scan/scene.hpp"

namespace tanglebin {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using test::random_direction;
using test::random_point;

const Capsule upright{Vector3d(0, 0, 0), Vector3d(0, 0, 2), 1};
const AlignedBox3d cube(Vector3d(-1, -1, -1), Vector3d(1, 1, 1));

using SignedDistance = std::function<double(const Vector3d&)>;

double capsule_distance(const Capsule& capsule, const Vector3d& p) {
  const Vector3d axis = capsule.b - capsule.a;
  const double t = axis.squaredNorm() > 0 ? (p - capsule.a).dot(axis) / axis.squaredNorm() : 0;
  return (p - capsule.a - std::clamp(t, 0.0, 1.0) * axis).norm() - capsule.radius;
}

double box_distance(const AlignedBox3d& box, const Vector3d& p) {
  const Vector3d beyond = (p - box.center()).cwiseAbs() - box.sizes() / 2;
  return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

/// An independent truth. The signed distance to a convex solid is convex along a ray, so its least value is
/// found by ternary search, and the crossings lie to either side of it.
struct Found {
  double least;                    ///< of the signed distance along the ray
  std::optional<double> crossing;  ///< the first t >= 0 at which it is 0
};

Found search(const Ray& ray, const SignedDistance& distance, double far) {
  const auto at = [&](double t) { return distance(ray.origin + t * ray.direction); };
  double low = 0;
  double high = far;
  for (int i = 0; i < 150; ++i) {
    const double third = (high - low) / 3;
    (at(low + third) < at(high - third) ? high : low) += at(low + third) < at(high - third) ? -third : third;
  }
  const double deepest = (low + high) / 2;
  Found truth{at(deepest), std::nullopt};
  if (truth.least > 0) return truth;
  const bool inside = at(0) < 0;
  double outer = inside ? far : 0;
  double inner = deepest;
  for (int i = 0; i < 100; ++i) {
    const double middle = (outer + inner) / 2;
    (at(middle) > 0 ? outer : inner) = middle;
  }
  truth.crossing = (outer + inner) / 2;
  return truth;
}

/// Compares a closed form with the search, but for rays so close to tangent that rounding decides.
void expect_agreement(const Ray& ray, const std::optional<SurfaceHit>& hit, const SignedDistance& distance) {
  constexpr double tangent = 1e-12;
  const Found truth = search(ray, distance, 20);
  if (std::abs(truth.least) < tangent) return;
  ASSERT_EQ(hit.has_value(), truth.crossing.has_value()) << "closest approach " << truth.least;
  if (!hit) return;
  const Vector3d point = ray.origin + hit->distance * ray.direction;
  EXPECT_NEAR(distance(point), 0, 1e-13);
  EXPECT_NEAR(hit->normal.norm(), 1, 1e-12);
  EXPECT_NEAR(distance(point + 1e-4 * hit->normal), 1e-4, 1e-12) << "the normal is not that of the surface";
  // Where the ray grazes, a distance is as uncertain as its surface's rounding error over the slope.
  const double slope = std::abs(hit->normal.dot(ray.direction));
  EXPECT_NEAR(hit->distance, *truth.crossing, 1e-13 / std::max(slope, 1e-6));
}

/// Of a capsule that is cut flat, whose signed distance is not known in closed form: the largest of those of
/// its convex parts has the same zeros and sign.
double cut_capsule_distance(const Capsule& capsule, const Vector3d& p) {
  const Vector3d axis = (capsule.b - capsule.a).normalized();
  double distance = capsule_distance(capsule, p);
  if (capsule.flat_at_a) distance = std::max(distance, (capsule.a - p).dot(axis));
  if (capsule.flat_at_b) distance = std::max(distance, (p - capsule.b).dot(axis));
  return distance;
}

TEST(RayCapsule, MeetsTheDiscOfAFlatEnd) {
  Capsule flat = upright;
  flat.flat_at_b = true;
  const auto down = ray_capsule({Vector3d(0.6, 0, 10), Vector3d(0, 0, -1)}, flat);
  ASSERT_TRUE(down);
  EXPECT_DOUBLE_EQ(down->distance, 8);
  EXPECT_TRUE(down->normal.isApprox(Vector3d(0, 0, 1)));
  const auto up = ray_capsule({Vector3d(0, 0, -10), Vector3d(0, 0, 1)}, flat);
  ASSERT_TRUE(up);
  EXPECT_DOUBLE_EQ(up->distance, 9) << "the other end is round";
  EXPECT_FALSE(ray_capsule({Vector3d(-5, 0, 2.1), Vector3d(1, 0, 0)}, flat)) << "through the lost hemisphere";
  const auto out = ray_capsule({Vector3d(0, 0, 1), Vector3d(0, 0, 1)}, flat);
  ASSERT_TRUE(out);
  EXPECT_DOUBLE_EQ(out->distance, 1) << "from inside";
  EXPECT_TRUE(out->normal.isApprox(Vector3d(0, 0, 1)));
}

TEST(RayCapsule, FlatEndsAgreeWithASearchAlongTheRay) {
  Rng rng(11);
  const AlignedBox3d space(Vector3d(-1, -1, -1), Vector3d(1, 1, 1));
  int discs = 0;
  for (int i = 0; i < 3000; ++i) {
    const Capsule capsule{.a = random_point(rng, space),
                          .b = random_point(rng, space),
                          .radius = uniform_real(rng, 0.05, 0.5),
                          .flat_at_a = i % 3 != 0,
                          .flat_at_b = i % 3 != 1};
    const Ray ray{5 * random_direction(rng), random_direction(rng)};
    const Ray aimed{ray.origin, (random_point(rng, space) - ray.origin).normalized()};
    const auto hit = ray_capsule(aimed, capsule);
    const auto distance = [&](const Vector3d& p) { return cut_capsule_distance(capsule, p); };
    const Found truth = search(aimed, distance, 20);
    if (std::abs(truth.least) < 1e-9) continue;
    ASSERT_EQ(hit.has_value(), truth.crossing.has_value()) << "closest approach " << truth.least;
    if (!hit) continue;
    EXPECT_NEAR(distance(aimed.origin + hit->distance * aimed.direction), 0, 1e-12);
    EXPECT_NEAR(hit->distance, *truth.crossing, 1e-5);
    EXPECT_LE(hit->normal.dot(aimed.direction), 0);
    const Vector3d axis = (capsule.b - capsule.a).normalized();
    if (std::abs(hit->normal.dot(axis)) > 1 - 1e-12) ++discs;
  }
  EXPECT_GT(discs, 50);
}

TEST(RayCapsule, MeetsTheSideOfTheCylinder) {
  const auto hit = ray_capsule({Vector3d(5, 0, 1), Vector3d(-1, 0, 0)}, upright);
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->distance, 4);
  EXPECT_TRUE(hit->normal.isApprox(Vector3d(1, 0, 0)));
}

TEST(RayCapsule, MeetsTheSideAtAnAngle) {
  const auto hit = ray_capsule({Vector3d(3, 0, 3), Vector3d(-1, 0, -1).normalized()}, upright);
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->distance, 2 * std::sqrt(2));
  EXPECT_TRUE(hit->normal.isApprox(Vector3d(1, 0, 0)));
}

TEST(RayCapsule, AlongTheAxisMeetsTheNearerEnd) {
  const auto down = ray_capsule({Vector3d(0, 0, 10), Vector3d(0, 0, -1)}, upright);
  ASSERT_TRUE(down);
  EXPECT_DOUBLE_EQ(down->distance, 7);
  EXPECT_TRUE(down->normal.isApprox(Vector3d(0, 0, 1)));
  const auto up = ray_capsule({Vector3d(0, 0, -10), Vector3d(0, 0, 1)}, upright);
  ASSERT_TRUE(up);
  EXPECT_DOUBLE_EQ(up->distance, 9);
}

TEST(RayCapsule, ParallelToTheAxisMeetsTheHemisphereOrNothing) {
  const auto hit = ray_capsule({Vector3d(0.6, 0, 10), Vector3d(0, 0, -1)}, upright);
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->distance, 7.2);
  EXPECT_TRUE(hit->normal.isApprox(Vector3d(0.6, 0, 0.8)));
  EXPECT_FALSE(ray_capsule({Vector3d(1.001, 0, 10), Vector3d(0, 0, -1)}, upright));
}

TEST(RayCapsule, FromInsideFindsTheWayOut) {
  const auto side = ray_capsule({Vector3d(0, 0, 1), Vector3d(0, 1, 0)}, upright);
  ASSERT_TRUE(side);
  EXPECT_DOUBLE_EQ(side->distance, 1);
  EXPECT_TRUE(side->normal.isApprox(Vector3d(0, 1, 0)));
  const auto end = ray_capsule({Vector3d(0, 0, 1), Vector3d(0, 0, 1)}, upright);
  ASSERT_TRUE(end);
  EXPECT_DOUBLE_EQ(end->distance, 2);
}

TEST(RayCapsule, BehindTheRayThereIsNothing) {
  EXPECT_FALSE(ray_capsule({Vector3d(5, 0, 1), Vector3d(1, 0, 0)}, upright));
  EXPECT_FALSE(ray_capsule({Vector3d(0, 0, 3.1), Vector3d(0, 0, 1)}, upright));
}

TEST(RayCapsule, TheSilhouetteIsSharpToANanometre) {
  constexpr double nanometre = 1e-9;
  const auto passes = [](double x) {
    return ray_capsule({Vector3d(x, -2, 1), Vector3d(0, 1, 0)}, upright).has_value();
  };
  EXPECT_TRUE(passes(1 - nanometre));
  EXPECT_FALSE(passes(1 + nanometre));
}

TEST(RayCapsule, WithCoincidingEndsIsASphere) {
  const Capsule sphere{Vector3d(1, 2, 3), Vector3d(1, 2, 3), 0.5};
  const auto hit = ray_capsule({Vector3d(1.3, 2, 0), Vector3d(0, 0, 1)}, sphere);
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->distance, 3 - 0.4);
  EXPECT_TRUE(hit->normal.isApprox(Vector3d(0.6, 0, -0.8)));
  EXPECT_FALSE(ray_capsule({Vector3d(1.51, 2, 0), Vector3d(0, 0, 1)}, sphere));
}

RC_GTEST_PROP(RayCapsule, AgreesWithASearchAlongTheRay, (std::uint64_t seed)) {
  SCOPED_TRACE(seed);
  Rng rng(seed);
  for (int i = 0; i < 30; ++i) {
    const double radius = std::pow(10, uniform_real(rng, -3, -1));
    const double length = uniform_integer(rng, 0, 9) == 0 ? 0 : std::pow(10, uniform_real(rng, -3, 0));
    const Vector3d a = random_point(rng, cube);
    const Vector3d axis = random_direction(rng);
    const Capsule capsule{a, a + length * axis, radius};
    // Aimed at a point on or near the capsule, from within it to metres away.
    const Vector3d aim =
        a + uniform_real(rng, 0, length) * axis + uniform_real(rng, 0, 1.2 * radius) * random_direction(rng);
    const Vector3d direction = random_direction(rng);
    const Ray ray{aim - uniform_real(rng, 0, 5) * direction, direction};
    expect_agreement(ray, ray_capsule(ray, capsule),
                     [&](const Vector3d& p) { return capsule_distance(capsule, p); });
  }
}

RC_GTEST_PROP(RayCapsule, AgreesWithASearchNearlyAlongTheAxis, (std::uint64_t seed)) {
  SCOPED_TRACE(seed);
  Rng rng(seed);
  for (int i = 0; i < 30; ++i) {
    const Vector3d axis = random_direction(rng);
    const Vector3d a = random_point(rng, cube);
    const Capsule capsule{a, a + 0.3 * axis, 0.01};
    const double deviation = std::pow(10, uniform_real(rng, -17, -1));
    const Vector3d direction = (axis + deviation * random_direction(rng)).normalized();
    const Vector3d aim = a + uniform_real(rng, 0, 0.3) * axis + 0.012 * random_direction(rng);
    const Ray ray{aim - 2 * direction, direction};
    expect_agreement(ray, ray_capsule(ray, capsule),
                     [&](const Vector3d& p) { return capsule_distance(capsule, p); });
  }
}

TEST(RayBox, MeetsTheFaceThatLooksAtTheRay) {
  const auto hit = ray_box({Vector3d(0.2, 0.3, 5), Vector3d(0, 0, -1)}, cube);
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->distance, 4);
  EXPECT_EQ(hit->normal, Vector3d(0, 0, 1));
}

TEST(RayBox, FromInsideFindsTheWayOut) {
  const auto hit = ray_box({Vector3d::Zero(), Vector3d(-1, 0, 0)}, cube);
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->distance, 1);
  EXPECT_EQ(hit->normal, Vector3d(-1, 0, 0));
}

TEST(RayBox, BehindTheRayOrBesideItThereIsNothing) {
  EXPECT_FALSE(ray_box({Vector3d(0, 0, 5), Vector3d(0, 0, 1)}, cube));
  EXPECT_FALSE(ray_box({Vector3d(1.001, 0, 5), Vector3d(0, 0, -1)}, cube));
  EXPECT_FALSE(ray_box({Vector3d(-3, 0, 5.1), Vector3d(1, 0, -1).normalized()}, cube));
}

TEST(RayBox, ARayInThePlaneOfAFaceTouchesTheBox) {
  const auto hit = ray_box({Vector3d(1, 0, 5), Vector3d(0, 0, -1)}, cube);
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->distance, 4);
  EXPECT_EQ(hit->normal, Vector3d(0, 0, 1));
}

RC_GTEST_PROP(RayBox, AgreesWithASearchAlongTheRay, (std::uint64_t seed)) {
  SCOPED_TRACE(seed);
  Rng rng(seed);
  for (int i = 0; i < 30; ++i) {
    const Vector3d corner = random_point(rng, cube);
    const AlignedBox3d box(corner, corner + random_point(rng, {Vector3d::Constant(0.01), Vector3d::Ones()}));
    const Vector3d aim = box.center() + random_point(rng, cube).cwiseProduct(0.6 * box.sizes());
    const Vector3d direction = random_direction(rng);
    const Ray ray{aim - uniform_real(rng, 0, 5) * direction, direction};
    expect_agreement(ray, ray_box(ray, box), [&](const Vector3d& p) { return box_distance(box, p); });
  }
}

}  // namespace
}  // namespace tanglebin
