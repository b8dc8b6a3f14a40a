#include "tanglebin/model/locate/locate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/random.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tests/scan/scene.hpp"

namespace tanglebin {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::degree;
using testing::AllOf;
using testing::HasSubstr;

/// A bin, a camera over it, and what the camera sees.
struct ScanOfBin {
  Support support;  // where it is
  Camera camera;
  PointCloud cloud;
};

Camera camera_over(double tilt_deg, double distance) {
  const Vector3d target(0, 0, 0.1);
  const Vector3d back(std::sin(tilt_deg * degree), 0, std::cos(tilt_deg * degree));
  Camera camera = test::camera_at(target + distance * back, target, 640, 400, 50 * degree);
  // The image's x axis is level.
  const Vector3d z = -back;
  camera.pose.linear() << -Vector3d::UnitY(), z.cross(-Vector3d::UnitY()), z;
  return camera;
}

ScanOfBin scan_of(const Bin& bin, const std::vector<Tube>& tubes, const Camera& camera) {
  return {{.bin = bin},
          camera,
          cloud_from_scan(scan(tubes, bin, camera), CloudOf::tubes_and_bin, static_cast<int>(tubes.size()))};
}

std::vector<Tube> some_tubes(int count, const Bin& bin) {
  Rng rng(test::seed);
  return test::random_pile(rng, count, bin);
}

void move_scan(ScanOfBin& scan, const Isometry3d& motion) {
  for (Eigen::Vector3f& point : scan.cloud.points) point = (motion * point.cast<double>()).cast<float>();
  scan.camera.pose = motion * scan.camera.pose;
  scan.support.pose = motion * scan.support.pose;
}

// The same scan in the camera's frame.
void move_into_camera(ScanOfBin& scan) {
  move_scan(scan, scan.camera.pose.inverse(Eigen::Isometry));
}

Support guessed(const ScanOfBin& scan, const Isometry3d& guess) {
  Support support = scan.support;
  support.pose = guess;
  return support;
}

Located located_without_guess(const ScanOfBin& scan) {
  return locate(scan.cloud, guessed(scan, Isometry3d::Identity()), scan.camera);
}

double degrees_between(const Isometry3d& first, const Isometry3d& second) {
  return Eigen::AngleAxisd(first.linear().transpose() * second.linear()).angle() / degree;
}

void expect_near(const Isometry3d& found, const Isometry3d& truth, double metres, double degrees) {
  EXPECT_LT((found.translation() - truth.translation()).norm(), metres);
  EXPECT_LT(degrees_between(found, truth), degrees);
}

std::string refusal(const ScanOfBin& scan) {
  try {
    located_without_guess(scan);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// A table around the bin, under it by `below`.
void add_table_around(ScanOfBin& scan, double below) {
  const double x = scan.support.bin.length / 2 + scan.support.bin.wall;
  const double y = scan.support.bin.width / 2 + scan.support.bin.wall;
  for (int v = 0; v < scan.camera.height; ++v) {
    for (int u = 0; u < scan.camera.width; ++u) {
      const Ray ray = ray_through(scan.camera, u, v);
      const Vector3d point = ray.origin + (-below - ray.origin.z()) / ray.direction.z() * ray.direction;
      if (std::abs(point.x()) > x || std::abs(point.y()) > y)
        scan.cloud.points.emplace_back(point.cast<float>());
    }
  }
}

TEST(Locate, FindsAnEmptyBinFromAboveExactly) {
  const ScanOfBin scan = scan_of({}, {}, camera_over(0, 1));
  const Located located = located_without_guess(scan);
  expect_near(located.support.pose, Isometry3d::Identity(), 0.0002, 0.02);
  EXPECT_LT(located.residual, 0.0001);
  EXPECT_GT(located.explained, 0.97);
  EXPECT_LT(located.contradicted, 0.01);
}

TEST(Locate, FindsABinThatStandsObliquelyInTheCamerasFrame) {
  for (const double tilt_deg : {20.0, 45.0}) {
    ScanOfBin scan = scan_of({}, some_tubes(5, {}), camera_over(tilt_deg, 1.2));
    move_into_camera(scan);
    const Located located = locate(scan.cloud, guessed(scan, scan.support.pose), scan.camera);
    expect_near(located.support.pose, scan.support.pose, 0.0005, 0.05);
    EXPECT_EQ(located.support.bin, scan.support.bin);
  }
}

TEST(Locate, FindsABinOfWhichTubesHideMost) {
  const ScanOfBin scan = scan_of({}, some_tubes(25, {}), camera_over(10, 1));
  const Located located = located_without_guess(scan);
  expect_near(located.support.pose, Isometry3d::Identity(), 0.0005, 0.05);
  EXPECT_LT(located.explained, 0.6);
}

TEST(Locate, MovesWithTheCloud) {
  ScanOfBin scan = scan_of({}, some_tubes(3, {}), camera_over(25, 1));
  const Isometry3d before = located_without_guess(scan).support.pose;
  Isometry3d motion(Eigen::AngleAxisd(2, Vector3d(1, -2, 3).normalized()));
  motion.pretranslate(Vector3d(1, -2, 0.5));
  move_scan(scan, motion);
  const Located after = locate(scan.cloud, guessed(scan, motion * before), scan.camera);
  expect_near(after.support.pose, motion * before, 1e-4, 0.01);
}

TEST(Locate, OfPosesThatLookTheSameTakesTheNearestToTheGuess) {
  const Isometry3d half_turn(Eigen::AngleAxisd(180 * degree, Vector3d::UnitZ()));
  const Isometry3d quarter_turn(Eigen::AngleAxisd(90 * degree, Vector3d::UnitZ()));
  const ScanOfBin oblong = scan_of({}, {}, camera_over(10, 1));
  expect_near(locate(oblong.cloud, guessed(oblong, half_turn), oblong.camera).support.pose, half_turn, 0.0005,
              0.05);
  const ScanOfBin square = scan_of({.length = 0.4, .width = 0.4}, {}, camera_over(10, 1));
  expect_near(locate(square.cloud, guessed(square, quarter_turn), square.camera).support.pose, quarter_turn,
              0.0005, 0.05);
}

/// A bin with tubes, and beside it at +y, `distance` (m) from its middle, an empty one.
ScanOfBin scan_of_two_bins(double distance) {
  const Camera camera = camera_over(20, 2);
  ScanOfBin both = scan_of({}, some_tubes(8, {}), camera);
  const Eigen::Translation3d aside(0, distance, 0);
  Camera from_second = camera;
  from_second.pose = aside.inverse() * camera.pose;
  for (const Eigen::Vector3f& point : scan_of({}, {}, from_second).cloud.points)
    both.cloud.points.emplace_back((aside * point.cast<double>()).cast<float>());
  return both;
}

TEST(Locate, OfTwoBinsTakesTheOneAtTheGuess) {
  const ScanOfBin scan = scan_of_two_bins(0.5);
  for (const double at : {0.0, 0.5}) {
    const Isometry3d truth(Eigen::Translation3d(0, at, 0));
    const Isometry3d guess(Eigen::Translation3d(-0.05, at + 0.08, 0.03));
    expect_near(locate(scan.cloud, guessed(scan, guess), scan.camera).support.pose, truth, 0.002, 0.1);
  }
}

TEST(Locate, OfTwoBinsTakesNoneIfTheGuessIsAtNeither) {
  ScanOfBin scan = scan_of_two_bins(0.5);
  const Isometry3d off(Eigen::Translation3d(0, 0, -2));
  move_scan(scan, off);
  EXPECT_THAT(refusal(scan),
              AllOf(HasSubstr("support.position"), HasSubstr("2 bins of these sizes are seen")));
}

TEST(Locate, IsNotMisledByTheTableAroundTheBin) {
  ScanOfBin scan = scan_of({.length = 0.35, .width = 0.25, .height = 0.12}, {}, camera_over(20, 1));
  add_table_around(scan, scan.support.bin.wall);
  expect_near(located_without_guess(scan).support.pose, Isometry3d::Identity(), 0.0005, 0.05);
}

ScanOfBin realistic_scan_of(const Bin& bin, const std::vector<Tube>& tubes, const Camera& camera) {
  const Sensor sensor = sensor_preset("zivid-one-plus-l");
  return {{.bin = bin},
          camera,
          cloud_from_scan(scan(tubes, bin, camera, sensor, test::seed), CloudOf::tubes_and_bin,
                          static_cast<int>(tubes.size()))};
}

TEST(Locate, FindsABinThroughARealisticScannerAndSaysHowWell) {
  const ScanOfBin scan = realistic_scan_of({}, some_tubes(6, {}), camera_over(15, 1.5));
  const Located located = located_without_guess(scan);
  expect_near(located.support.pose, Isometry3d::Identity(), 0.002, 0.3);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GT(located.position_sd[axis], 0);
    EXPECT_LT(std::abs(located.support.pose.translation()[axis]), 4 * located.position_sd[axis]);
  }
}

// Moves a share of the points along their lines of sight, to anywhere.
void add_specks(ScanOfBin& scan, double share) {
  Rng rng(test::seed);
  const Vector3d camera = scan.camera.pose.translation();
  for (Eigen::Vector3f& point : scan.cloud.points) {
    if (uniform_real(rng, 0, 1) > share) continue;
    point = (camera + uniform_real(rng, 0.7, 1.05) * (point.cast<double>() - camera)).cast<float>();
  }
}

TEST(Locate, IsNotMisledBySpecks) {
  const Bin bin{.length = 0.3, .width = 0.2, .height = 0.12, .wall = 0.003};
  ScanOfBin scan = scan_of(bin, {}, camera_over(20, 0.6));
  add_specks(scan, 0.05);
  expect_near(located_without_guess(scan).support.pose, Isometry3d::Identity(), 0.0005, 0.05);
}

TEST(Locate, MeasuresTheBinsSizes) {
  ScanOfBin scan = scan_of({.length = 0.553, .width = 0.368}, {}, camera_over(30, 1.2));
  scan.support.bin = {};
  const Located located = located_without_guess(scan);
  EXPECT_NEAR(located.measured.length, 0.553, 0.001);
  EXPECT_NEAR(located.measured.width, 0.368, 0.001);
  expect_near(located.support.pose, Isometry3d::Identity(), 0.001, 0.05);
}

TEST(Locate, RefusesABinOfOtherSizes) {
  ScanOfBin scan = scan_of({}, some_tubes(3, {}), camera_over(20, 1.2));
  const std::vector<Bin> others{{.length = 0.50}, {.width = 0.45}, {.height = 0.10}, {.height = 0.31}};
  for (const Bin& other : others) {
    scan.support.bin = other;
    EXPECT_THAT(refusal(scan), HasSubstr("not located"))
        << other.length << ' ' << other.width << ' ' << other.height;
  }
}

TEST(Locate, NamesTheWallOfABinWhoseRimIsNotThatThick) {
  ScanOfBin scan = scan_of({}, some_tubes(3, {}), camera_over(20, 1.2));
  scan.support.bin.wall = 0.08;
  EXPECT_THAT(refusal(scan),
              HasSubstr("the rim is not 0.200 m above the floor, or not 0.080 m thick: of its"));
}

// Turned by 90°, such a bin has two walls on true ones, and the others where nothing is measured.
TEST(Locate, RefusesTheOuterSizesOfABin) {
  const Bin bin{.length = 0.6, .width = 0.4, .height = 0.2, .wall = 0.01};
  ScanOfBin scan = realistic_scan_of(bin, some_tubes(12, bin), camera_over(12, 1.6));
  scan.support.bin = {.length = 0.62, .width = 0.42, .height = 0.2, .wall = 0.02};
  EXPECT_THAT(refusal(scan), HasSubstr("not located"));
}

TEST(Locate, TakesNoPartOfATableForARim) {
  ScanOfBin scan = realistic_scan_of(test::wide_bin(), some_tubes(8, {}), camera_over(12, 1.2));
  scan.support.bin = {.length = 0.3, .width = 0.2, .height = 0.1};
  EXPECT_THAT(refusal(scan), HasSubstr("not located"));
}

// The image ends some centimetres inside of the bin.
TEST(Locate, RefusesABinWhoseRimIsOutsideOfTheImage) {
  const Bin bin{.length = 0.6, .width = 0.4, .height = 0.2, .wall = 0.01};
  for (const double inside : {0.02, 0.04, 0.06}) {
    ScanOfBin scan = realistic_scan_of(bin, some_tubes(4, bin), camera_over(12, 1.6));
    std::erase_if(scan.cloud.points, [&](const Eigen::Vector3f& point) {
      return std::abs(point.x()) > bin.length / 2 - inside || std::abs(point.y()) > bin.width / 2 - inside;
    });
    EXPECT_THAT(refusal(scan), HasSubstr("not located")) << inside;
  }
}

// The wall's thickness, which may not have been told, is not to blame.
TEST(Locate, SaysThatTheRimIsNotInACloudThatIsCroppedToTheInsideOfTheBin) {
  const Bin bin{.length = 0.6, .width = 0.4, .height = 0.12, .wall = 0.01};
  ScanOfBin scan = realistic_scan_of(bin, some_tubes(10, bin), camera_over(0, 1.2));
  std::erase_if(scan.cloud.points, [&](const Eigen::Vector3f& point) {
    return !is_over_floor(bin, point.cast<double>(), 0.01);
  });
  EXPECT_THAT(refusal(scan),
              AllOf(HasSubstr("not located: the rim is not in the cloud where the sizes have it"),
                    HasSubstr("was the cloud cropped to the inside of the bin?")));
}

TEST(Locate, RefusesATableWithoutABin) {
  ScanOfBin scan = scan_of(test::wide_bin(), some_tubes(4, {}), camera_over(20, 1));
  scan.support.bin = {};
  EXPECT_THAT(refusal(scan), HasSubstr("not located"));
}

TEST(Locate, RefusesABinOfWhichOneCornerIsInTheCloud) {
  ScanOfBin scan = scan_of({}, {}, camera_over(20, 1));
  std::erase_if(scan.cloud.points,
                [](const Eigen::Vector3f& point) { return point.x() > -0.2 || point.y() > -0.1; });
  EXPECT_THAT(refusal(scan), HasSubstr("not located"));
}

TEST(Locate, SaysThatTheCloudIsNotInTheImage) {
  ScanOfBin scan = scan_of({}, {}, camera_over(20, 1));
  const Isometry3d in_camera = scan.camera.pose.inverse(Eigen::Isometry);
  for (Eigen::Vector3f& point : scan.cloud.points) point = (in_camera * point.cast<double>()).cast<float>();
  EXPECT_THAT(refusal(scan), AllOf(HasSubstr("cloud"), HasSubstr("in the camera's image")));
  scan.cloud.points.resize(10);
  EXPECT_THAT(refusal(scan), HasSubstr("found 10 points"));
}

TEST(Locate, AsksWhetherZPointsBackwardsIfAllIsBehindTheCamera) {
  ScanOfBin scan = scan_of({}, {}, camera_over(20, 1));
  const Isometry3d turned(Eigen::AngleAxisd(180 * degree, Vector3d::UnitX()));
  scan.camera.pose = scan.camera.pose * turned;
  EXPECT_THAT(refusal(scan),
              HasSubstr("Nearly all are behind the camera: if z points backwards, as in OpenGL, "
                        "write (x, −y, −z) for each point"));
}

TEST(Locate, RefusesToLocateNothing) {
  ScanOfBin scan = scan_of({}, {}, camera_over(0, 1));
  scan.support.shape = Support::Shape::nothing;
  EXPECT_THAT(refusal(scan), AllOf(HasSubstr("support.shape"), HasSubstr("bin or plane")));
}

/// A plane with tubes on it: the floor of a bin as wide as the image.
ScanOfBin scan_of_plane(int tubes, double tilt_deg) {
  ScanOfBin scan = scan_of(test::wide_bin(), some_tubes(tubes, {}), camera_over(tilt_deg, 1));
  scan.support.shape = Support::Shape::plane;
  return scan;
}

TEST(Locate, FindsAPlaneUnderTubes) {
  for (const int tubes : {0, 8, 20}) {
    ScanOfBin scan = scan_of_plane(tubes, 30);
    move_into_camera(scan);
    const Located located = located_without_guess(scan);
    const Isometry3d off = scan.support.pose.inverse(Eigen::Isometry) * located.support.pose;
    EXPECT_LT(std::acos(std::min(1.0, off.linear()(2, 2))) / degree, 0.02) << tubes;
    EXPECT_LT(std::abs(off.translation().z()), 0.0002) << tubes;
  }
}

TEST(Locate, FindsAPlaneThroughARealisticScanner) {
  for (const char* scanner : {"zivid-one-plus-l", "kinect-v1", "phoxi"}) {
    ScanOfBin made = scan_of_plane(20, 10);
    Sensor sensor = sensor_preset(scanner);
    sensor.working_distance = 1;
    made.cloud = cloud_from_scan(scan(some_tubes(20, {}), test::wide_bin(), made.camera, sensor, test::seed),
                                 CloudOf::tubes_and_bin, 20);
    const Located located = located_without_guess(made);
    EXPECT_LT(std::abs(located.support.pose.translation().z()), 0.002) << scanner;
    EXPECT_LT(std::acos(std::min(1.0, located.support.pose.linear()(2, 2))) / degree, 0.3) << scanner;
  }
}

// A plane through the tubes has more points on it than any other.
TEST(Locate, RefusesAPlaneUnderTubesOfWhichNothingIsSeen) {
  for (const int tubes : {5, 10, 20}) {
    for (const double tilt_deg : {0.0, 30.0}) {
      ScanOfBin scan = scan_of_plane(tubes, tilt_deg);
      scan.cloud = cloud_from_scan(tanglebin::scan(some_tubes(tubes, {}), test::wide_bin(), scan.camera),
                                   CloudOf::tubes, tubes);
      EXPECT_THAT(refusal(scan), HasSubstr("not located")) << tubes << " " << tilt_deg;
    }
  }
}

// Their tops are all at one height.
TEST(Locate, RefusesAPlaneThroughTubesThatLieSideBySide) {
  ScanOfBin scan = scan_of_plane(0, 20);
  std::vector<Tube> tubes;
  for (int i = 0; i < 12; ++i) {
    const double y = 0.03 * (i - 6);
    tubes.push_back(test::chain(i + 1, 0.0125, {{-0.2, y, 0.0125}, {0.2, y, 0.0125}}));
  }
  scan.cloud = cloud_from_scan(tanglebin::scan(tubes, test::wide_bin(), scan.camera), CloudOf::tubes, 12);
  EXPECT_THAT(refusal(scan), HasSubstr("it cuts through the tubes"));
}

TEST(Locate, MovesThePoseOfAPlaneNoMoreThanItMust) {
  const ScanOfBin scan = scan_of_plane(3, 20);
  Isometry3d guess(Eigen::AngleAxisd(0.5, Vector3d::UnitZ()));
  guess.pretranslate(Vector3d(0.1, 0.2, 0.03));
  const Located located = locate(scan.cloud, guessed(scan, guess), scan.camera);
  Isometry3d expected = guess;
  expected.translation().z() = 0;
  expect_near(located.support.pose, expected, 0.0002, 0.02);
  EXPECT_EQ(located.position_sd.head<2>(), Eigen::Vector2d::Zero());
  EXPECT_GT(located.position_sd.z(), 0);
}

TEST(Locate, TakesThePlaneThatTheTubesLieOnNotTheTopOfABoxOnIt) {
  const ScanOfBin scan = [] {
    ScanOfBin made =
        scan_of({.length = 0.3, .width = 0.2, .height = 0.1, .wall = 0.1}, {}, camera_over(20, 1));
    made.support.shape = Support::Shape::plane;
    add_table_around(made, 0.1);
    return made;
  }();
  EXPECT_NEAR(located_without_guess(scan).support.pose.translation().z(), -0.1, 0.001);
}

}  // namespace
}  // namespace tanglebin
