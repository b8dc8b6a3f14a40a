#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <string_view>
#include <vector>

#include "tanglebin/scan/projector.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tests/scan/scene.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::seed;
using test::wide_bin;

// Where the two tangents from (x, z) to a circle meet the floor: the circle's shadow.
struct Interval {
  double left;
  double right;
};
Interval shadow_on_floor(double x, double z, double circle_x, double circle_z, double radius) {
  const double towards = std::atan2(circle_x - x, z - circle_z);
  const double half_angle = std::asin(radius / std::hypot(circle_x - x, z - circle_z));
  return {x + z * std::tan(towards - half_angle), x + z * std::tan(towards + half_angle)};
}

TEST(StructuredLight, TheProjectorIsBesideTheCameraAndLooksAtTheSamePoint) {
  const Camera camera = test::camera_at(Vector3d(0.3, -0.5, 1.7), Vector3d(0, 0, 0.1), 640, 480, 0.7);
  const Camera projector = projector_beside(camera, {.baseline = 0.3, .working_distance = 1.5});
  const Vector3d target =
      ray_through(camera, camera.cx, camera.cy).origin + 1.5 * camera.pose.linear().col(2);
  EXPECT_NO_THROW(validate(projector));
  EXPECT_NEAR((camera.pose.inverse() * projector.pose.translation() - Vector3d(0.3, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((*project(projector, target) - Eigen::Vector2d(camera.cx, camera.cy)).norm(), 0, 1e-9);
}

TEST(StructuredLight, ATubesShadowOnTheFloorIsAsWideAsTheTangentsSay) {
  constexpr double height = 2;
  const Camera camera = downward_camera(2001, 3, 20'000, Vector3d(0, 0, height));
  for (const double tube_height : {0.0125, 0.08, 0.15, 0.3}) {
    for (const double baseline : {0.1, 0.2, 0.4}) {
      const std::vector<Tube> tubes = {
          test::chain(1, 0.0125, {Vector3d(0, -1, tube_height), Vector3d(0, 1, tube_height)})};
      const Scan ideal = scan(tubes, wide_bin(), camera);
      const Scan measured = scan(tubes, wide_bin(), camera, {.shadows = true, .baseline = baseline}, seed);
      int lost = 0;
      for (int u = 0; u < camera.width; ++u) {
        if (ideal.at(u, 1).label == bin_label && measured.at(u, 1).label == null_label) ++lost;
      }
      const Interval dark = shadow_on_floor(baseline, height, 0, tube_height, 0.0125);
      const Interval hidden = shadow_on_floor(0, height, 0, tube_height, 0.0125);
      const double width = std::min(dark.right, hidden.left) - dark.left;  // that the tube does not hide
      EXPECT_NEAR(lost * height / camera.fx, width, 2 * height / camera.fx)
          << "tube at " << tube_height << ", baseline " << baseline;
    }
  }
}

TEST(StructuredLight, TheSideOfATubeThatIsTurnedFromTheProjectorIsDark) {
  const std::vector<Tube> tubes = {test::chain(1, 0.2, {Vector3d(0, -1, 0.3), Vector3d(0, 1, 0.3)})};
  const Camera camera = downward_camera(2001, 101, 2730, Vector3d(0, 0, 2));
  const Scan ideal = scan(tubes, wide_bin(), camera);
  const Scan measured = scan(tubes, wide_bin(), camera, {.shadows = true, .baseline = 0.6}, seed);
  for (int u = 0; u < camera.width; ++u) {
    const Pixel& pixel = ideal.at(u, 1);
    if (pixel.label != 1) continue;
    const double cosine =
        (Vector3d(0.6, 0, 2) - pixel.point.cast<double>()).normalized().dot(pixel.normal.cast<double>());
    if (std::abs(cosine) < 1e-3) continue;
    EXPECT_EQ(measured.at(u, 1).label == 1, cosine > 0) << "column " << u;
  }
}

TEST(StructuredLight, TheProjectorLightsOnlyItsOwnImage) {
  const Camera camera = downward_camera(400, 300, 400, Vector3d(0, 0, 1));
  const Scan measured = scan({}, wide_bin(), camera, {.shadows = true, .working_distance = 2}, seed);
  int first = 0;
  while (measured.at(first, 150).label == null_label) ++first;
  // The left edge of its image: half its width from its axis, which is tilted by 0.2 m in 2 m.
  const double edge = 0.2 - std::tan(std::atan(0.5) + std::atan(0.1));
  EXPECT_NEAR(first, camera.cx + 400 * edge, 1);
  EXPECT_EQ(measured.at(399, 150).label, bin_label);
}

// A camera above a wall's inner face, `offset` pixels over the rim: the edge between rim and floor is the
// column cx − offset.
Scan scan_of_an_edge(double offset, const Sensor& sensor) {
  const Bin bin{.length = 1, .width = 4, .height = 0.2, .wall = 0.3, .friction = 1};
  const double x = 0.5 + offset * 0.8 / 585;
  return scan({}, bin, downward_camera(61, 9, 585, Vector3d(x, 0, 1)), sensor, seed);
}

TEST(StructuredLight, TheDroppedBandAtAnEdgeIsAsWideAsTheSubRaysReach) {
  for (const Sensor& sensor :
       {Sensor{.edges = Edges::drop}, Sensor{.edges = Edges::drop, .footprint = 3, .sub_rays = 4},
        Sensor{.edges = Edges::drop, .footprint = 2.5, .sub_rays = 2}}) {
    const double width = sensor.footprint * (sensor.sub_rays - 1) / sensor.sub_rays;
    double dropped = 0;
    constexpr int offsets = 64;
    for (int i = 0; i < offsets; ++i) {
      const double edge = 30 - (i + 0.5) / offsets;
      const Scan measured = scan_of_an_edge(30 - edge, sensor);
      for (int u = 20; u < 40; ++u) {
        const bool lost = measured.at(u, 4).label == null_label;
        EXPECT_EQ(lost, std::abs(u - edge) < width / 2) << "column " << u << ", edge at " << edge;
        dropped += lost ? 1.0 / offsets : 0;
      }
    }
    EXPECT_NEAR(dropped, width, 1.0 / offsets);
  }
}

TEST(StructuredLight, AFlyingPixelHasTheMeanDepthOfItsSubRays) {
  const Scan measured = scan_of_an_edge(0.1, {.edges = Edges::mix, .footprint = 3, .sub_rays = 6});
  int mixed = 0;
  for (int u = 20; u < 40; ++u) {
    int on_floor = 0;
    for (int i = 0; i < 6; ++i) on_floor += u + (i + 0.5) * 0.5 - 1.5 < 29.9 ? 1 : 0;
    const bool straddles = on_floor > 0 && on_floor < 6;
    EXPECT_NEAR(measured.at(u, 4).depth, 0.8 + 0.2 * on_floor / 6, 1e-6) << "column " << u;
    EXPECT_EQ(measured.mixed[measured.index(u, 4)], straddles ? 1 : 0) << "column " << u;
    mixed += straddles ? 1 : 0;
  }
  EXPECT_GE(mixed, 2);
}

// The camera is above a wall's inner face, from under which the top of a thick tube comes, to the left of
// column 29.9; both surfaces are level where they are seen.
Scan scan_of_a_tube_under_the_rim(const Sensor& sensor) {
  const Bin bin{.length = 1, .width = 4, .height = 0.2, .wall = 0.3, .friction = 1};
  const std::vector<Tube> tubes = {test::chain(1, 0.5, {Vector3d(0.5, -1, -0.4), Vector3d(0.5, 1, -0.4)})};
  constexpr double focal_length = 58'500;
  const Vector3d position(0.5 + 0.1 * 0.8 / focal_length, 0, 1);
  return scan(tubes, bin, downward_camera(61, 9, focal_length, position), sensor, seed);
}

TEST(StructuredLight, AFlyingPixelsDepthIsWeightedBySignal) {
  const Sensor sensor{.edges = Edges::mix,
                      .footprint = 3,
                      .sub_rays = 6,
                      .signal = true,
                      .snr = 2,
                      .snr_min = 0,
                      .snr_max = 100,
                      .albedo_min = 0.9,
                      .albedo_max = 0.9,
                      .gloss_min = 0,
                      .gloss_max = 0,
                      .bin_albedo = 0.3,
                      .bin_gloss = 0};
  const auto snr_at = [](double depth, double albedo) {
    const double to_projector = std::hypot(0.2, depth);
    return 2 * std::pow(2 / to_projector, 2) * albedo * depth / to_projector;
  };
  const double rim = snr_at(0.8, 0.3);
  const double tube = snr_at(0.9, 0.9);
  const Scan measured = scan_of_a_tube_under_the_rim(sensor);
  int mixed = 0;
  for (int u = 20; u < 40; ++u) {
    int on_tube = 0;
    for (int i = 0; i < 6; ++i) on_tube += u + (i + 0.5) * 0.5 - 1.5 < 29.9 ? 1 : 0;
    const double signal = on_tube * tube + (6 - on_tube) * rim;
    const Pixel& pixel = measured.at(u, 4);
    EXPECT_NEAR(pixel.depth, (on_tube * tube * 0.9 + (6 - on_tube) * rim * 0.8) / signal, 1e-4)
        << "column " << u;
    EXPECT_NEAR(measured.snr[measured.index(u, 4)], signal / 6, 0.001 * signal) << "column " << u;
    const bool straddles = on_tube > 0 && on_tube < 6;
    EXPECT_EQ(measured.mixed[measured.index(u, 4)], straddles ? 1 : 0) << "column " << u;
    EXPECT_EQ(pixel.label, on_tube * tube > (6 - on_tube) * rim ? 1 : bin_label)
        << "more signal comes from it, column " << u;
    mixed += straddles ? 1 : 0;
  }
  EXPECT_GE(mixed, 2);
}

// The camera is above the bin's outermost edge, beyond which there is nothing.
TEST(StructuredLight, AFootprintThatReachesTheOuterRimSeesIt) {
  const Bin bin{.length = 1, .width = 4, .height = 0.2, .wall = 0.3, .friction = 1};
  const Camera camera = downward_camera(60, 9, 585, Vector3d(0.8, 0, 1));
  const Scan measured = scan({}, bin, camera, {.edges = Edges::mix, .footprint = 5, .sub_rays = 5}, seed);
  EXPECT_EQ(measured.at(31, 4).label, bin_label) << "its outermost sub-ray is half a pixel over the rim";
  EXPECT_NEAR(measured.at(31, 4).depth, 0.8, 1e-6);
  EXPECT_EQ(measured.at(32, 4).label, null_label);
}

// Where every sub-ray returns as much, that is the surface to which the mean depth is nearer. The tube's top
// is at a depth of 1.79 m, its outline at 1.80 m, the floor at 2 m.
TEST(StructuredLight, AFlyingPixelHasTheLabelOfTheSurfaceThatItSeesMostOf) {
  const std::vector<Tube> tubes = {test::chain(7, 0.0125, {Vector3d(-1, 0, 0.2), Vector3d(1, 0.1, 0.2)})};
  const Camera camera = downward_camera(320, 240, 2730, Vector3d(0, 0, 2));
  const Scan measured = scan(tubes, wide_bin(), camera, {.edges = Edges::mix}, seed);
  int upper = 0;
  int lower = 0;
  for (std::size_t i = 0; i < measured.pixels.size(); ++i) {
    const Pixel& pixel = measured.pixels[i];
    if (measured.mixed[i] == 0 || pixel.depth < 1.83F || pixel.depth > 1.97F) continue;
    if (pixel.depth < 1.895F) {
      EXPECT_EQ(pixel.label, 7) << pixel.depth;
      ++upper;
    } else if (pixel.depth > 1.905F) {
      EXPECT_EQ(pixel.label, bin_label) << pixel.depth;
      ++lower;
    }
  }
  EXPECT_GT(upper, 100) << "points fly between tube and floor";
  EXPECT_GT(lower, 100);
}

TEST(StructuredLight, AFlyingPixelThatSeesAsMuchOfTwoSurfacesHasTheLabelOfTheNearer) {
  const Scan measured = scan_of_a_tube_under_the_rim({.edges = Edges::mix, .footprint = 4, .sub_rays = 4});
  EXPECT_NEAR(measured.at(30, 4).depth, 0.85, 1e-4);
  EXPECT_EQ(measured.at(30, 4).label, bin_label);
  EXPECT_EQ(measured.at(29, 4).label, 1);
}

TEST(StructuredLight, LosesAPixelWhoseSignalIsWeak) {
  Camera camera = downward_camera(1200, 9, 600, Vector3d(0, 0, 1));
  camera.pose = Eigen::AngleAxisd(0.6, Vector3d::UnitY()) * camera.pose;
  const Sensor sensor{.signal = true, .snr_min = 0.2, .snr_max = 100, .bin_albedo = 1, .bin_gloss = 0};
  const Scan ideal = scan({}, wide_bin(), camera);
  const Scan measured = scan({}, wide_bin(), camera, sensor, seed);
  const Vector3d projector = projector_beside(camera, sensor).pose.translation();
  int lost = 0;
  for (int u = 0; u < camera.width; ++u) {
    const Pixel& pixel = ideal.at(u, 4);
    if (pixel.label != bin_label) continue;
    const Vector3d way = projector - pixel.point.cast<double>();
    const double snr =
        2 * 4 / way.squaredNorm() * (way.z() / way.norm()) * std::cos(static_cast<double>(pixel.incidence));
    if (std::abs(snr - 0.2) < 1e-4) continue;
    EXPECT_EQ(measured.at(u, 4).label == bin_label, snr > 0.2) << "column " << u;
    lost += snr < 0.2 ? 1 : 0;
  }
  EXPECT_GT(lost, 50);
}

TEST(StructuredLight, AHighlightIsLostWhereTheMirrorDirectionMeetsTheCamera) {
  const Camera camera = downward_camera(801, 801, 2730, Vector3d(0, 0, 2));
  const Sensor sensor{
      .signal = true, .snr = 2, .snr_max = 1.5, .shininess = 400, .bin_albedo = 0.25, .bin_gloss = 1};
  const Scan measured = scan({}, wide_bin(), camera, sensor, seed);
  const Scan ideal = scan({}, wide_bin(), camera);
  Vector3d sum = Vector3d::Zero();
  double lost = 0;
  for (std::size_t i = 0; i < ideal.pixels.size(); ++i) {
    if (measured.pixels[i].label != null_label) continue;
    sum += ideal.pixels[i].point.cast<double>();
    ++lost;
  }
  // Half-way to the projector, as large as 2 (0.25 + cos^400 psi) > 1.5 says, psi being two shifts a height.
  EXPECT_LT((sum / lost - Vector3d(0.1, 0, 0)).norm(), 0.001);
  const double psi = std::acos(std::pow(0.5, 1.0 / 400));
  const double area = std::numbers::pi * std::pow(psi * 2 / 2, 2);
  EXPECT_NEAR(lost * std::pow(2.0 / 2730, 2) / area, 1, 0.04);
}

/// Forty tubes beside each other, and how bright the brightest pixel of each is.
std::map<std::int32_t, double> brightest_of_tubes(const Sensor& sensor, std::string_view scanner) {
  std::vector<Tube> tubes;
  for (int id = 1; id <= 40; ++id) {
    const double y = 0.03 * (id - 20);
    tubes.push_back(test::chain(id, 0.0125, {Vector3d(-0.1, y, 0.0125), Vector3d(0.1, y, 0.0125)}));
  }
  const Camera camera = downward_camera(200, 1200, 1200, Vector3d(0, 0, 2));
  const Scan measured = scan(tubes, wide_bin(), camera, sensor, seed, scanner);
  std::map<std::int32_t, double> brightest;
  for (std::size_t i = 0; i < measured.pixels.size(); ++i) {
    if (measured.pixels[i].label == null_label) continue;
    double& snr = brightest[measured.pixels[i].label];
    snr = std::max(snr, static_cast<double>(measured.snr[i]));
  }
  brightest.erase(bin_label);
  return brightest;
}

/// Are the tubes' materials, of a property drawn between two limits, within them and different?
void expect_drawn_between(double lowest, double highest, const std::map<std::int32_t, double>& brightest) {
  ASSERT_EQ(brightest.size(), 40U);
  double least = highest;
  double greatest = lowest;
  for (const auto& [id, snr] : brightest) {
    EXPECT_LT(snr / 2, highest * 1.03) << "a little nearer than the working distance";
    EXPECT_GT(snr / 2, lowest * 0.85) << "seen and lit from the side";
    least = std::min(least, snr / 2);
    greatest = std::max(greatest, snr / 2);
  }
  EXPECT_GT(greatest - least, 0.6 * (highest - lowest));
}

const Sensor matt{.signal = true, .snr_min = 0, .snr_max = 100, .gloss_min = 0, .gloss_max = 0};
// Highlights are wide, so that a pixel sees their brightest point.
const Sensor mirrors{
    .signal = true, .snr_min = 0, .snr_max = 100, .albedo_min = 0, .albedo_max = 0, .shininess = 4};

TEST(StructuredLight, EachTubeHasItsOwnAlbedoAndGloss) {
  const auto albedos = brightest_of_tubes(matt, "");
  const auto glosses = brightest_of_tubes(mirrors, "");
  expect_drawn_between(0.35, 0.65, albedos);
  expect_drawn_between(0.1, 1, glosses);
  int only_one_above_the_middle = 0;
  for (const auto& [id, albedo] : albedos) {
    only_one_above_the_middle += (albedo / 2 > 0.5) != (glosses.at(id) / 2 > 0.55) ? 1 : 0;
  }
  EXPECT_GE(only_one_above_the_middle, 10) << "a bright tube need not shine";
}

TEST(StructuredLight, AllScannersOfASceneSeeTheSameMaterial) {
  for (const Sensor& sensor : {matt, mirrors}) {
    EXPECT_EQ(brightest_of_tubes(sensor, "left"), brightest_of_tubes(sensor, "right"));
  }
}

}  // namespace
}  // namespace tanglebin
