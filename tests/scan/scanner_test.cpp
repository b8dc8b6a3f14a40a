#include "tanglebin/scan/scanner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "tanglebin/geometry/intersect.hpp"
#include "tests/scan/scene.hpp"

namespace tanglebin {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

struct Seen {
  double range;
  Vector3d normal;
  std::int32_t label;
};

/// The truth: the nearest of all closed-form intersections in double precision.
class Truth {
public:
  Truth(const std::vector<Tube>& tubes, const Bin& bin) : boxes_(boxes(bin)) {
    for (const Tube& tube : tubes) {
      for (const Capsule& capsule : capsules(tube)) capsules_.emplace_back(tube.id, capsule);
    }
  }

  std::optional<Seen> along(const Ray& ray) const {
    std::optional<Seen> first;
    const auto consider = [&](const std::optional<SurfaceHit>& hit, std::int32_t label) {
      if (hit && (!first || hit->distance < first->range)) first = Seen{hit->distance, hit->normal, label};
    };
    for (const AlignedBox3d& box : boxes_) consider(ray_box(ray, box), bin_label);
    for (const auto& [label, capsule] : capsules_) {
      if (may_meet(ray, capsule)) consider(ray_capsule(ray, capsule), label);
    }
    return first;
  }

private:
  /// Does the ray's line meet a sphere around the capsule? Saves most of the time.
  static bool may_meet(const Ray& ray, const Capsule& capsule) {
    const double radius = 0.501 * (capsule.b - capsule.a).norm() + 1.001 * capsule.radius;
    return ray.direction.cross((capsule.a + capsule.b) / 2 - ray.origin).squaredNorm() < radius * radius;
  }

  std::array<AlignedBox3d, 5> boxes_;
  std::vector<std::pair<std::int32_t, Capsule>> capsules_;
};

bool contains(const PixelWindow& window, int u, int v) {
  return u >= window.left && u < window.left + window.width && v >= window.top &&
         v < window.top + window.height;
}

/// How a scan differs from the truth in every `stride`-th row and column of the whole image.
struct Difference {
  int pixels = 0;
  int wrong_labels = 0;  ///< also: something seen where there is nothing, or outside of the window
  double depth = 0;      ///< m, the largest
  double normal = 0;     ///< the largest
};

Difference compare(const Scan& scan, const std::vector<Tube>& tubes, const Bin& bin, int row_stride,
                   int column_stride) {
  Difference difference;
  const Truth all(tubes, bin);
  for (int v = 0; v < scan.camera.height; v += row_stride) {
    for (int u = 0; u < scan.camera.width; u += column_stride) {
      ++difference.pixels;
      const Ray ray = ray_through(scan.camera, u, v);
      const auto truth = all.along(ray);
      const std::int32_t label = contains(scan.window, u, v) ? scan.at(u, v).label : null_label;
      if (label != (truth ? truth->label : null_label)) {
        ++difference.wrong_labels;
      } else if (truth) {
        const Pixel& pixel = scan.at(u, v);
        const Vector3d point = ray.origin + truth->range * ray.direction;
        const double depth = (scan.camera.pose.inverse() * point).z();
        difference.depth = std::max(difference.depth, std::abs(pixel.depth - depth));
        difference.normal = std::max(difference.normal, (pixel.normal.cast<double>() - truth->normal).norm());
      }
    }
  }
  return difference;
}

void expect_exact(const Scan& scan, const std::vector<Tube>& tubes, const Bin& bin, int row_stride = 1,
                  int column_stride = 1) {
  const Difference difference = compare(scan, tubes, bin, row_stride, column_stride);
  EXPECT_GT(difference.pixels, 0);
  EXPECT_EQ(difference.wrong_labels, 0) << "of " << difference.pixels << " pixels";
  // 10 µm are promised at 2 m; what is left is the rounding of a depth to single precision, 0.12 µm.
  EXPECT_LT(difference.depth, 0.2e-6);
  EXPECT_LT(difference.normal, 1e-6);
}

std::map<std::int32_t, int> histogram(const Scan& scan) {
  std::map<std::int32_t, int> counts;
  for (const Pixel& pixel : scan.pixels) ++counts[pixel.label];
  return counts;
}

std::vector<Tube> pile_of_20() {
  Rng rng(2022);
  return test::random_pile(rng, 20, Bin{});
}

TEST(Scanner, EveryPixelOfThePaperCameraIsExact) {
  const auto tubes = pile_of_20();
  const Scan result = scan(tubes, Bin{}, camera_preset("paper"));
  const PixelWindow& window = result.window;
  // Every pixel of the window, and of the rest of the image in a coarse grid.
  const Truth all(tubes, Bin{});
  int wrong = 0;
  double depth_error = 0;
  for (int v = window.top; v < window.top + window.height; ++v) {
    for (int u = window.left; u < window.left + window.width; ++u) {
      const Ray ray = ray_through(result.camera, u, v);
      const auto truth = all.along(ray);
      const Pixel& pixel = result.at(u, v);
      if (pixel.label != (truth ? truth->label : null_label)) ++wrong;
      if (truth)
        depth_error = std::max(depth_error, std::abs(pixel.depth + truth->range * ray.direction.z()));
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_LT(depth_error, 0.2e-6);
  expect_exact(result, tubes, Bin{}, 37, 41);
}

TEST(Scanner, ZividCameraIsExact) {
  const auto tubes = pile_of_20();
  expect_exact(scan(tubes, Bin{}, camera_preset("zivid-one-plus-l")), tubes, Bin{}, 13, 3);
}

TEST(Scanner, IsExactFromAllSides) {
  Rng rng(7);
  const Bin bin;
  const auto tubes = test::random_pile(rng, 10, bin);
  for (int view = 0; view < 12; ++view) {
    const Vector3d position = uniform_real(rng, 0.7, 3) * test::random_direction(rng);
    const Camera camera = test::camera_at(position, Vector3d(0, 0, 0.1), 97, 73, uniform_real(rng, 0.2, 2));
    expect_exact(scan(tubes, bin, camera), tubes, bin);
  }
}

TEST(Scanner, IsExactFromWithinTheBinWhereTheWindowIsTheWholeImage) {
  Rng rng(8);
  const Bin bin;
  const auto tubes = test::random_pile(rng, 10, bin);
  for (int view = 0; view < 12; ++view) {
    const Vector3d position = test::random_point(rng, {Vector3d(-0.27, -0.18, 0), Vector3d(0.27, 0.18, 0.2)});
    const Camera camera = test::camera_at(position, position + test::random_direction(rng), 60, 40, 1.2);
    const Scan result = scan(tubes, bin, camera);
    EXPECT_EQ(result.pixels.size(), 60U * 40U);
    expect_exact(result, tubes, bin);
  }
}

TEST(Scanner, IsExactForPixelsOfManyDegrees) {
  const auto tubes = pile_of_20();
  for (const int width : {1, 2, 7, 9, 16}) {
    const Camera camera = test::camera_at(Vector3d(0.1, 0.05, 0.4), Vector3d::Zero(), width, width, 2.8);
    expect_exact(scan(tubes, Bin{}, camera), tubes, Bin{});
  }
}

TEST(Scanner, IsExactWhereTubesAreSeenAlongTheirAxes) {
  // An odd image has a pixel whose ray is the axis itself.
  const Camera camera = downward_camera(401, 301, 1000, Vector3d(0, 0, 2));
  std::vector<Tube> tubes = {
      test::chain(1, 0.0125, {Vector3d(0, 0, 0.02), Vector3d(0, 0, 0.19)}),
      test::chain(2, 0.0125, {Vector3d(0.1, 0, 0.02), Vector3d(0.1, 0, 0.19)}),
      test::chain(3, 0.0125, {Vector3d(0, 0.1, 0.02), Vector3d(0, 0.091, 0.2)}),  // points at the camera
      test::chain(4, 0.02, {Vector3d(-0.1, 0, 0.02), Vector3d(-0.1, 0, 0.1), Vector3d(-0.1, 0.1, 0.1)})};
  const Scan result = scan(tubes, Bin{}, camera);
  expect_exact(result, tubes, Bin{});
  EXPECT_EQ(result.at(200, 150).label, 1);
  EXPECT_NEAR(result.at(200, 150).depth, 2 - 0.19 - 0.0125, 1e-6);
}

TEST(Scanner, SeesCylindersOfNoLength) {
  const std::vector<Tube> tubes = {test::chain(1, 0.02, {Vector3d(0, 0, 0.1), Vector3d(0, 0, 0.1)}),
                                   test::chain(2, 0.02, {Vector3d(0.1, 0, 0.1), Vector3d(0.1001, 0, 0.1)})};
  const Scan result = scan(tubes, Bin{}, camera_preset("paper"));
  expect_exact(result, tubes, Bin{}, 2, 2);
  EXPECT_GT(histogram(result)[1], 100);
  EXPECT_GT(histogram(result)[2], 100);
}

TEST(Scanner, PixelsAreConsistentInThemselves) {
  const auto tubes = pile_of_20();
  Camera camera = test::camera_at(Vector3d(0.5, -1, 1.5), Vector3d(0, 0, 0.1), 480, 300, 0.6);
  const Scan result = scan(tubes, Bin{}, camera);
  const PixelWindow& window = result.window;
  int seen = 0;
  for (int v = window.top; v < window.top + window.height; ++v) {
    for (int u = window.left; u < window.left + window.width; ++u) {
      const Pixel& pixel = result.at(u, v);
      if (pixel.label == null_label) {
        EXPECT_TRUE(std::isnan(pixel.depth) && std::isnan(pixel.range) && std::isnan(pixel.incidence) &&
                    pixel.point.array().isNaN().all() && pixel.normal.array().isNaN().all());
        continue;
      }
      ++seen;
      const Vector3d point = pixel.point.cast<double>();
      const Vector3d normal = pixel.normal.cast<double>();
      const Vector3d to_camera = camera.pose.translation() - point;
      ASSERT_LT((*project(camera, point) - Eigen::Vector2d(u, v)).norm(), 1e-3);
      ASSERT_NEAR((camera.pose.inverse() * point).z(), pixel.depth, 1e-6);
      ASSERT_NEAR(to_camera.norm(), pixel.range, 1e-6);
      ASSERT_NEAR(normal.norm(), 1, 1e-6);
      ASSERT_NEAR(std::cos(pixel.incidence), normal.dot(to_camera.normalized()), 1e-6);
      ASSERT_LE(pixel.incidence, std::numbers::pi / 2 + 1e-6) << "a surface seen from behind";
    }
  }
  EXPECT_GT(seen, 10000);
}

double distance_to(const Tube& tube, const Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Capsule& c : capsules(tube)) {
    const Vector3d axis = c.b - c.a;
    const double t = std::clamp((p - c.a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - c.a - t * axis).norm() - c.radius);
  }
  return least;
}

TEST(Scanner, PointsLieOnTheSurfaceThatTheyAreLabelledWith) {
  const auto tubes = pile_of_20();
  const Scan result = scan(tubes, Bin{}, camera_preset("paper"));
  for (const Pixel& pixel : result.pixels) {
    if (pixel.label == null_label) continue;
    const Vector3d point = pixel.point.cast<double>();
    double distance = std::numeric_limits<double>::infinity();
    if (pixel.label == bin_label) {
      for (const AlignedBox3d& box : boxes(Bin{})) distance = std::min(distance, box.exteriorDistance(point));
    } else {
      distance = distance_to(tubes[static_cast<std::size_t>(pixel.label - 1)], point);
    }
    ASSERT_NEAR(distance, 0, 1e-6);
    for (const Tube& tube : tubes) ASSERT_GT(distance_to(tube, point), -1e-6) << "a point inside a tube";
  }
}

TEST(Scanner, ALevelTubeHasThePixelsOfItsSilhouette) {
  const double radius = 0.0125;
  const Vector3d half(0.15, 0.1, 0);
  const Vector3d centre(0, 0, 0.02);
  const Camera camera = camera_preset("paper");
  auto counts = histogram(scan({test::chain(1, radius, {centre - half, centre + half})}, Bin{}, camera));
  const double pixel = (2 - centre.z()) / camera.fx;
  const double silhouette = 4 * radius * half.norm() + std::numbers::pi * radius * radius;
  EXPECT_NEAR(counts[1] * pixel * pixel, silhouette, 0.01 * silhouette);
  EXPECT_GT(counts[bin_label], 100000);
}

TEST(Scanner, LabelsAreTheIdsOfTheTubes) {
  const auto tubes = std::vector{test::chain(7, 0.0125, {Vector3d(-0.2, 0, 0.02), Vector3d(0.2, 0, 0.02)}),
                                 test::chain(3, 0.0125, {Vector3d(0, -0.1, 0.1), Vector3d(0, 0.1, 0.1)})};
  const auto counts = histogram(scan(tubes, Bin{}, camera_preset("paper")));
  EXPECT_TRUE(counts.contains(7) && counts.contains(3) && counts.contains(bin_label));
  EXPECT_EQ(counts.size(), 3U + (counts.contains(null_label) ? 1U : 0U));
}

TEST(Scanner, AHiddenTubeHasNoPixels) {
  const auto above = test::chain(1, 0.0125, {Vector3d(-0.2, 0, 0.1), Vector3d(0.2, 0, 0.1)});
  const auto below = test::chain(2, 0.0125, {Vector3d(-0.15, 0, 0.05), Vector3d(0.15, 0, 0.05)});
  EXPECT_FALSE(histogram(scan({above, below}, Bin{}, camera_preset("paper"))).contains(2));
  EXPECT_TRUE(histogram(scan({below}, Bin{}, camera_preset("paper"))).contains(2));
}

TEST(Scanner, OfCoincidingSurfacesTheFirstTubeIsSeen) {
  const auto points = {Vector3d(-0.2, 0.03, 0.1), Vector3d(0.2, -0.01, 0.1)};
  const auto counts = histogram(
      scan({test::chain(5, 0.0125, points), test::chain(2, 0.0125, points)}, Bin{}, camera_preset("paper")));
  EXPECT_TRUE(counts.contains(5));
  EXPECT_FALSE(counts.contains(2));
}

TEST(Scanner, TheWindowHoldsTheBinAndLittleElse) {
  const Scan result = scan({}, Bin{}, camera_preset("paper"));
  // The rim, 0.59 m x 0.41 m outside, lies 1.8 m below the camera.
  EXPECT_NEAR(result.window.width, 0.59 / 1.8 * result.camera.fx, 3);
  EXPECT_NEAR(result.window.height, 0.41 / 1.8 * result.camera.fx, 3);
  EXPECT_GT(histogram(result)[bin_label], 0.98 * result.window.width * result.window.height);
}

TEST(Scanner, ATubeOutsideOfTheBinIsInTheWindow) {
  const Tube fallen = test::chain(1, 0.0125, {Vector3d(0.5, 0, 0), Vector3d(0.6, 0.1, 0)});
  const Scan result = scan({fallen}, Bin{}, camera_preset("paper"));
  EXPECT_GT(histogram(result)[1], 1000);
  expect_exact(result, {fallen}, Bin{}, 5, 5);
}

TEST(Scanner, ACameraThatLooksAwaySeesNothing) {
  const Camera away = test::camera_at(Vector3d(0, 0, 2), Vector3d(0, 0, 3), 640, 480, 1);
  EXPECT_TRUE(scan(pile_of_20(), Bin{}, away).pixels.empty());
  const Camera beside = downward_camera(640, 480, 500, Vector3d(5, 0, 2));
  EXPECT_TRUE(scan(pile_of_20(), Bin{}, beside).pixels.empty());
}

TEST(Scanner, ScansOfOneSceneAreTheSameBytes) {
  const auto tubes = pile_of_20();
  const Scan first = scan(tubes, Bin{}, camera_preset("paper"));
  const Scan second = scan(tubes, Bin{}, camera_preset("paper"));
  ASSERT_EQ(first.pixels.size(), second.pixels.size());
  EXPECT_EQ(std::memcmp(first.pixels.data(), second.pixels.data(), first.pixels.size() * sizeof(Pixel)), 0);
}

TEST(Scanner, LeavesTheCallersFloatingPointStateAlone) {
  const int rounding = std::fegetround();
  const auto result = scan(pile_of_20(), Bin{}, camera_preset("paper"));
  EXPECT_EQ(std::fegetround(), rounding);
  volatile double denormal = 1e-310;
  EXPECT_GT(denormal / 2, 0) << "denormal numbers are flushed to zero";
}

TEST(Scanner, ATiltedBinIsSeenAsAnUprightOneByATiltedCamera) {
  Rng rng(test::seed);
  const std::vector<Tube> tubes = test::random_pile(rng, 3, Bin{});
  const Camera camera = test::camera_at({0.2, 0.1, 1}, {0, 0, 0}, 160, 120, 0.7);
  const Scan upright = scan(tubes, Bin{}, camera);
  Eigen::Isometry3d motion(Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized()));
  motion.translation() = Vector3d(0.1, -0.2, 0.3);
  std::vector<Tube> moved_tubes = tubes;
  for (Tube& tube : moved_tubes) transform(tube, motion);
  Camera moved_camera = camera;
  moved_camera.pose = motion * camera.pose;
  const Scan tilted = scan(moved_tubes, Support{.pose = motion}, moved_camera);
  ASSERT_EQ(tilted.pixels.size(), upright.pixels.size());
  EXPECT_EQ(tilted.camera, moved_camera);
  int different = 0;
  for (std::size_t i = 0; i < upright.pixels.size(); ++i) {
    const Pixel& pixel = tilted.pixels[i];
    different += pixel.label != upright.pixels[i].label ? 1 : 0;
    if (pixel.label != upright.pixels[i].label || pixel.label == null_label) continue;
    EXPECT_NEAR(pixel.depth, upright.pixels[i].depth, 1e-5);
    EXPECT_LT((motion * upright.pixels[i].point.cast<double>() - pixel.point.cast<double>()).norm(), 1e-5);
    EXPECT_LT(
        (motion.linear() * upright.pixels[i].normal.cast<double>() - pixel.normal.cast<double>()).norm(),
        1e-4);
  }
  EXPECT_LE(different, 3);  // at silhouettes
}

TEST(Scanner, SeesAPlaneAsFarAsItReachesAndWithoutASupportOnlyTubes) {
  const std::vector<Tube> tubes = {test::chain(1, 0.02, {{-0.1, 0, 0.02}, {0.1, 0, 0.02}})};
  const Camera camera = downward_camera(80, 60, 50, {0, 0, 1});
  const Scan plane = scan(tubes, Support{.shape = Support::Shape::plane}, camera);
  ASSERT_EQ(plane.pixels.size(), 80U * 60U);
  for (const Pixel& pixel : plane.pixels) {
    ASSERT_NE(pixel.label, null_label);
    if (pixel.label == bin_label) {
      EXPECT_NEAR(pixel.point.z(), 0, 1e-6);
    }
  }
  const Scan nothing = scan(tubes, Support{.shape = Support::Shape::nothing}, camera);
  EXPECT_TRUE(shows_a_tube(nothing));
  for (const Pixel& pixel : nothing.pixels) EXPECT_NE(pixel.label, bin_label);
  EXPECT_TRUE(scan({}, Support{.shape = Support::Shape::nothing}, camera).pixels.empty());
}

}  // namespace
}  // namespace tanglebin
