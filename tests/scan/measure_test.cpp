#include "tanglebin/scan/measure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "tanglebin/scan/range_error.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tests/scan/scene.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using test::degree;
using test::seed;
using test::wide_bin;

/// 120,000 pixels of a Zivid's focal length that look straight down.
Camera camera_above(double height) {
  return downward_camera(400, 300, 2730, Vector3d(0, 0, height));
}

/// The same at 2 m from a point of the floor, so that the floor's normal is inclined to the optical axis.
Camera inclined_camera(double angle) {
  Camera camera = camera_above(2);
  camera.pose = Eigen::AngleAxisd(angle, Vector3d::UnitY()) * camera.pose;
  return camera;
}

/// A cylinder of 0.2 m radius that fills the image.
std::vector<Tube> thick_tube() {
  return {test::chain(1, 0.2, {Vector3d(-3, 0, 0.3), Vector3d(3, 0, 0.3)})};
}

struct Statistics {
  std::size_t count = 0;
  double mean = 0;
  double deviation = 0;
};

Statistics statistics(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  double sum = 0;
  for (const double value : values) sum += value;
  const double mean = sum / n;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {values.size(), mean, std::sqrt(squares / n)};
}

/// `error(measured, ideal)` of every pixel that was measured.
template <typename Error>
std::vector<double> errors(const Scan& measured, const Scan& ideal, const Error& error) {
  std::vector<double> result;
  for (std::size_t i = 0; i < measured.pixels.size(); ++i) {
    if (measured.pixels[i].label != null_label) result.push_back(error(measured.pixels[i], ideal.pixels[i]));
  }
  return result;
}

double range_error(const Pixel& measured, const Pixel& ideal) {
  return static_cast<double>(measured.range) - static_cast<double>(ideal.range);
}

/// Standard deviation within 2 %, mean within four of its standard errors.
void expect_noise(const std::vector<double>& values, double sigma) {
  const Statistics found = statistics(values);
  ASSERT_GT(found.count, 20'000U);
  EXPECT_NEAR(found.deviation, sigma, 0.02 * sigma);
  EXPECT_LT(std::abs(found.mean), 4 * sigma / std::sqrt(static_cast<double>(found.count)));
}

std::size_t measured_pixels(const Scan& scan) {
  return static_cast<std::size_t>(
      std::ranges::count_if(scan.pixels, [](const Pixel& pixel) { return pixel.label != null_label; }));
}

struct View {
  std::vector<Tube> tubes;
  Camera camera;
};

std::vector<View> views() {
  return {{{}, camera_above(2)},
          {{}, camera_above(0.8)},
          {{}, inclined_camera(30 * degree)},
          {{}, inclined_camera(60 * degree)},
          {thick_tube(), camera_above(2)}};
}

TEST(Measure, NothingSwitchedOnIsTheIdealScan) {
  const auto tubes = thick_tube();
  const Scan ideal = scan(tubes, wide_bin(), camera_above(2));
  const Scan measured = scan(tubes, wide_bin(), camera_above(2), Sensor{}, seed);
  ASSERT_EQ(measured.pixels.size(), ideal.pixels.size());
  EXPECT_EQ(std::memcmp(measured.pixels.data(), ideal.pixels.data(), ideal.pixels.size() * sizeof(Pixel)), 0);
  EXPECT_TRUE(measured.snr.empty());
}

TEST(Measure, GaussianNoiseIsAsConfiguredOnPlanesAndCylindersAtAnyDistanceAndAngle) {
  for (const auto& [tubes, camera] : views()) {
    const Scan ideal = scan(tubes, wide_bin(), camera);
    expect_noise(errors(scan(tubes, wide_bin(), camera, {.sigma = 0.0005}, seed), ideal, range_error),
                 0.0005);
  }
}

TEST(Measure, NoiseOfAColumnIsCorrelatedAsConfiguredAndOfARowNot) {
  constexpr double correlation = 0.6;
  const Camera camera = camera_above(2);
  const Scan ideal = scan({}, wide_bin(), camera);
  const Scan measured =
      scan({}, wide_bin(), camera, {.sigma = 0.0005, .column_correlation = correlation}, seed);
  expect_noise(errors(measured, ideal, range_error), 0.0005);
  const auto correlation_at = [&](int right, int down) {
    double sum = 0;
    int count = 0;
    for (int v = 0; v + down < camera.height; ++v) {
      for (int u = 0; u + right < camera.width; ++u, ++count) {
        sum += range_error(measured.at(u, v), ideal.at(u, v)) *
               range_error(measured.at(u + right, v + down), ideal.at(u + right, v + down));
      }
    }
    return sum / count / (0.0005 * 0.0005);
  };
  constexpr double four_errors = 0.02;
  EXPECT_NEAR(correlation_at(0, 1), correlation, four_errors);
  EXPECT_NEAR(correlation_at(0, 2), correlation * correlation, four_errors);
  EXPECT_NEAR(correlation_at(1, 0), 0, four_errors);
  EXPECT_NEAR(correlation_at(1, 1), 0, four_errors);
}

TEST(Measure, QuantizedDepthsAreTheNearestSteps) {
  const Camera camera = inclined_camera(30 * degree);
  const Scan ideal = scan({}, wide_bin(), camera);
  const Scan measured = scan({}, wide_bin(), camera, {.quantization = 0.004}, seed);
  for (std::size_t i = 0; i < ideal.pixels.size(); i += 7) {
    const double steps = measured.pixels[i].depth / 0.004;
    ASSERT_NEAR(steps, std::round(steps), 1e-3);
    ASSERT_LE(std::abs(measured.pixels[i].depth - ideal.pixels[i].depth), 0.002 + 1e-6);
  }
}

TEST(Measure, AMedianTakesMostOfTheNoiseAway) {
  const Camera camera = camera_above(2);
  const Scan ideal = scan({}, wide_bin(), camera);
  const Scan measured = scan({}, wide_bin(), camera, {.sigma = 0.0005, .median = 5}, seed);
  std::vector<double> inside;  // of the image, where windows are whole
  for (int v = 2; v < camera.height - 2; ++v) {
    for (int u = 2; u < camera.width - 2; ++u)
      inside.push_back(range_error(measured.at(u, v), ideal.at(u, v)));
  }
  // Of n values, the median's variance is about pi / 2n times theirs.
  EXPECT_NEAR(statistics(inside).deviation, 0.0005 * std::sqrt(std::numbers::pi / 2 / 25), 0.000005);
}

TEST(Measure, NoiseMovesAPointAlongItsRayAlone) {
  const Camera camera = camera_above(2);
  const Scan measured = scan({}, wide_bin(), camera, {.sigma = 0.002}, seed);
  for (int u = 0; u < camera.width; u += 7) {
    const Pixel& pixel = measured.at(u, 11);
    const Ray ray = ray_through(camera, u, 11);
    const Vector3d expected = ray.origin + pixel.range * ray.direction;
    EXPECT_LT((pixel.point.cast<double>() - expected).norm(), 1e-6);
    EXPECT_NEAR(pixel.depth, 2 - expected.z(), 1e-6);
  }
}

TEST(Measure, DisparityNoiseGrowsWithTheSquareOfTheDepth) {
  const Sensor sensor{.disparity_sigma = 0.04};
  EXPECT_NEAR(disparity_depth_sigma(sensor, camera_above(2), 2, 1), 0.293e-3, 0.001e-3);
  for (const auto& [tubes, camera] : views()) {
    const Scan ideal = scan(tubes, wide_bin(), camera);
    const Scan measured = scan(tubes, wide_bin(), camera, sensor, seed);
    expect_noise(errors(measured, ideal,
                        [](const Pixel& found, const Pixel& truth) {
                          const double z = truth.depth;
                          return (found.depth - z) / (z * z / (2730 * 0.2) * 0.04);
                        }),
                 1);
  }
}

TEST(Measure, DisparityNoiseFallsWithTheSignal) {
  const Camera camera = camera_above(2);
  const Scan ideal = scan({}, wide_bin(), camera);
  const Sensor sensor{
      .signal = true, .snr = 4, .snr_max = 100, .bin_albedo = 0.8, .bin_gloss = 0, .disparity_sigma = 0.04};
  const Scan measured = scan({}, wide_bin(), camera, sensor, seed);
  std::vector<double> normalized;
  for (std::size_t i = 0; i < ideal.pixels.size(); ++i) {
    // The floor, a matt plane: distance to the projector and the cosines of incidence are known.
    const Vector3d point = ideal.pixels[i].point.cast<double>();
    const double to_projector = (point - Vector3d(0.2, 0, 2)).norm();
    const double snr = 4 * 0.8 * (2 * 2) / (to_projector * to_projector) * (2 / to_projector) *
                       std::cos(ideal.pixels[i].incidence);
    EXPECT_NEAR(measured.snr[i], snr, 1e-5);
    normalized.push_back((measured.pixels[i].depth - 2.0) / (4 / (2730 * 0.2) * 0.04 / snr));
  }
  expect_noise(normalized, 1);
}

/// A surface of which a Kinect, by its focal length, sees nothing else.
struct KinectView {
  std::vector<Tube> tubes;
  Camera camera;
};

std::vector<KinectView> kinect_views() {
  std::vector<KinectView> views;
  for (const double height : {0.8, 1.5, 3.0}) {
    views.push_back({{}, downward_camera(400, 300, 585, Vector3d(0, 0, height))});
  }
  for (const double angle : {30 * degree, 60 * degree}) {
    Camera camera = downward_camera(400, 300, 585, Vector3d(0, 0, 2));
    camera.pose = Eigen::AngleAxisd(angle, Vector3d::UnitY()) * camera.pose;
    views.push_back({{}, camera});
  }
  const Tube cylinder = test::chain(1, 1, {Vector3d(-9, 0, 1), Vector3d(9, 0, 1)});
  views.push_back({{cylinder}, downward_camera(300, 480, 585, Vector3d(0, 0, 3))});
  return views;
}

// Nguyen et al. measured what is left of a plane's depths, whatever made them err: the shift of rays on a
// slope adds nothing to it.
TEST(Measure, KinectNoiseIsNguyensOnPlanesAndACylinder) {
  for (const auto& [tubes, camera] : kinect_views()) {
    const Scan ideal = scan(tubes, wide_bin(), camera);
    const Scan measured = scan(tubes, wide_bin(), camera, {.kinect_noise = true}, seed);
    expect_noise(errors(measured, ideal,
                        [](const Pixel& found, const Pixel& truth) {
                          const double z = truth.depth;
                          const double steepness = truth.incidence / (90 * degree - truth.incidence);
                          const double sigma = 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4) +
                                               0.0001 / std::sqrt(z) * steepness * steepness;
                          return (found.depth - z) / sigma;
                        }),
                 1);
  }
  EXPECT_NEAR(kinect_axial_sigma(1, 60 * degree), 0.0012 + 0.0019 * 0.36 + 0.0001 * 4, 1e-9);
  EXPECT_NEAR(kinect_lateral_sigma(45 * degree), 0.835, 1e-9);
}

// The camera is right above the inner face of a wall, so that the rim's edge is between two columns.
TEST(Measure, KinectEdgesAreBlurredByTheLateralNoise) {
  const Bin bin{.length = 1, .width = 4, .height = 0.2, .wall = 0.3, .friction = 1};
  const Camera camera = downward_camera(60, 480, 585, Vector3d(0.5, 0, 1));
  const Scan measured = scan({}, bin, camera, {.kinect_noise = true}, seed);
  const boost::math::normal normal;
  for (int u = 28; u < 32; ++u) {
    int rim = 0;
    for (int v = 0; v < camera.height; ++v) rim += measured.at(u, v).depth < 0.9 ? 1 : 0;
    const double expected = boost::math::cdf(normal, (u - camera.cx) / 0.8);
    const double error = std::sqrt(expected * (1 - expected) / camera.height);
    EXPECT_NEAR(rim / static_cast<double>(camera.height), expected, 4 * error) << "column " << u;
  }
}

// The camera is right above the bin's outermost edge, which is between two columns; there is nothing beyond.
TEST(Measure, TheKinectsOuterRimIsRaggedOutwardsToo) {
  const Bin bin{.length = 1, .width = 4, .height = 0.2, .wall = 0.3, .friction = 1};
  const Camera camera = downward_camera(60, 1920, 585, Vector3d(0.8, 0, 1));
  const Scan measured = scan({}, bin, camera, {.kinect_noise = true}, seed);
  const boost::math::normal normal;
  for (int u = 30; u < 33; ++u) {
    int rim = 0;
    for (int v = 0; v < camera.height; ++v) rim += measured.at(u, v).label == bin_label ? 1 : 0;
    const double expected = boost::math::cdf(normal, (camera.cx - u) / 0.8);
    const double error = std::sqrt(expected * (1 - expected) / camera.height);
    EXPECT_NEAR(rim / static_cast<double>(camera.height), expected, 4 * error) << "column " << u;
  }
}

TEST(Measure, DropsOutAsManyPixelsAsConfigured) {
  const Camera camera = camera_above(2);
  for (const double share : {0.01, 0.1, 0.5}) {
    const std::size_t pixels = scan({}, wide_bin(), camera).pixels.size();
    const double lost =
        static_cast<double>(pixels - measured_pixels(scan({}, wide_bin(), camera, {.dropout = share}, seed)));
    const boost::math::binomial binomial(static_cast<double>(pixels), share);
    EXPECT_GT(lost, boost::math::quantile(binomial, 1e-4));
    EXPECT_LT(lost, boost::math::quantile(boost::math::complement(binomial, 1e-4)));
  }
}

/// Takes over from another sensor whether a term is on.
struct Switch {
  const char* name;
  void (*copy)(const Sensor& from, Sensor& to);
};

constexpr std::array<Switch, 8> switches{
    {{"sigma", [](const Sensor& from, Sensor& to) { to.sigma = from.sigma; }},
     {"dropout", [](const Sensor& from, Sensor& to) { to.dropout = from.dropout; }},
     {"edges", [](const Sensor& from, Sensor& to) { to.edges = from.edges; }},
     {"shadows", [](const Sensor& from, Sensor& to) { to.shadows = from.shadows; }},
     {"signal", [](const Sensor& from, Sensor& to) { to.signal = from.signal; }},
     {"disparity", [](const Sensor& from, Sensor& to) { to.disparity_sigma = from.disparity_sigma; }},
     {"trueness", [](const Sensor& from, Sensor& to) { to.trueness = from.trueness; }},
     {"kinect", [](const Sensor& from, Sensor& to) { to.kinect_noise = from.kinect_noise; }}}};

class Draws : public testing::Test {
protected:
  Scan scan_by(const Sensor& sensor) const { return scan(tubes_, wide_bin(), camera_, sensor, seed); }

  /// With or without the others, a term changes each range by the same, and drop-outs lose the same pixels.
  void expect_independent_of_others(const Sensor& all, const Switch& term) const {
    Sensor others = all;
    Sensor alone{};
    term.copy(Sensor{}, others);
    term.copy(all, alone);
    const Scan with = scan_by(all);
    const Scan without = scan_by(others);
    const Scan only = scan_by(alone);
    const Scan lossy = scan_by({.dropout = others.dropout});
    int compared = 0;
    for (std::size_t i = 0; i < with.pixels.size(); ++i) {
      const bool drops_out = lossy.pixels[i].label == null_label;
      EXPECT_TRUE(!drops_out || without.pixels[i].label == null_label) << term.name;
      if (!is_unmixed(with, i) || !is_unmixed(without, i) || !is_unmixed(only, i)) continue;
      const double change = range_error(with.pixels[i], without.pixels[i]);
      EXPECT_NEAR(change, range_error(only.pixels[i], ideal_.pixels[i]), 1e-6) << term.name;
      ++compared;
    }
    EXPECT_GT(compared, 8'000) << term.name;
  }

private:
  static bool is_unmixed(const Scan& scan, std::size_t i) {
    return scan.pixels[i].label != null_label && (scan.mixed.empty() || scan.mixed[i] == 0);
  }

  const std::vector<Tube> tubes_ = {test::chain(1, 0.05, {Vector3d(-3, 0, 0.05), Vector3d(3, 0, 0.05)})};
  const Camera camera_ = downward_camera(160, 120, 1000, Vector3d(0, 0, 2));
  const Scan ideal_ = scan(tubes_, wide_bin(), camera_);
};

TEST_F(Draws, OfATermAreTheSameWhicheverOthersAreOn) {
  const Sensor all{.sigma = 0.001,
                   .dropout = 0.2,
                   .edges = Edges::mix,
                   .shadows = true,
                   .disparity_sigma = 0.1,
                   .trueness = 0.0005};
  for (const Switch& term : switches) expect_independent_of_others(all, term);
}

TEST_F(Draws, AreTheSameWhereASignalLosesPixelsOrTheKinectMovesRays) {
  // Without the noise of the disparity, which the signal scales.
  const Sensor all{.sigma = 0.001, .dropout = 0.2, .signal = true, .trueness = 0.0005, .kinect_noise = true};
  for (const Switch& term : switches) expect_independent_of_others(all, term);
}

TEST(Measure, TheSameSeedGivesTheSameBytesAndAnotherOneOthers) {
  const auto tubes = thick_tube();
  const Camera camera = camera_above(2);
  const Sensor sensor = sensor_preset("zivid-one-plus-l");
  const Scan first = scan(tubes, wide_bin(), camera, sensor, seed);
  const Scan second = scan(tubes, wide_bin(), camera, sensor, seed);
  const Scan other = scan(tubes, wide_bin(), camera, sensor, seed + 1);
  const auto bytes = first.pixels.size() * sizeof(Pixel);
  EXPECT_EQ(std::memcmp(first.pixels.data(), second.pixels.data(), bytes), 0);
  EXPECT_EQ(first.snr, second.snr);
  EXPECT_NE(std::memcmp(first.pixels.data(), other.pixels.data(), bytes), 0);
}

TEST(Measure, TheCalibrationsErrorIsSmoothAndAsLargeAsConfigured) {
  const Camera camera = camera_above(2);
  const Scan ideal = scan({}, wide_bin(), camera);
  const Sensor sensor{.trueness = 0.001, .trueness_length = 100};
  std::vector<double> at_a_pixel;
  const PixelWindow one_pixel{.left = 200, .top = 150, .width = 1, .height = 1};
  for (std::uint64_t scanner = 0; scanner < 20'000; ++scanner) {
    at_a_pixel.push_back(trueness_errors(sensor, one_pixel, scanner)[0]);
  }
  EXPECT_NEAR(statistics(at_a_pixel).mean, 0, 4 * 0.001 / std::sqrt(20'000.0));
  EXPECT_NEAR(statistics(at_a_pixel).deviation, 0.001, 0.02 * 0.001);

  const Scan measured = scan({}, wide_bin(), camera, sensor, seed);
  const auto error = [&](int u, int v) { return range_error(measured.at(u, v), ideal.at(u, v)); };
  EXPECT_NEAR(error(200, 150), trueness_errors(sensor, one_pixel, seed)[0], 1e-6);
  for (int u = 1; u < camera.width; ++u) EXPECT_LT(std::abs(error(u, 150) - error(u - 1, 150)), 0.0001);
}

TEST(Measure, TheCalibrationsErrorChangesOverTheLengthConfigured) {
  constexpr int scanners = 10'000;
  constexpr int length = 40;
  const Sensor sensor{.trueness = 0.001, .trueness_length = length};
  for (const PixelWindow& line : {PixelWindow{.left = 300, .top = 200, .width = 81, .height = 1},
                                  PixelWindow{.left = 300, .top = 200, .width = 1, .height = 81}}) {
    std::map<int, double> covariance;
    for (std::uint64_t scanner = 0; scanner < scanners; ++scanner) {
      const std::vector<float> along = trueness_errors(sensor, line, scanner);
      for (const int distance : {20, 40, 80}) {
        covariance[distance] += along[0] * along[static_cast<std::size_t>(distance)] / scanners;
      }
    }
    for (const auto& [distance, value] : covariance) {
      const double expected = std::exp(-std::pow(distance, 2) / (2.0 * length * length));
      EXPECT_NEAR(value / (0.001 * 0.001), expected, 4 * std::sqrt(2.0 / scanners)) << distance << " pixels";
    }
  }
}

}  // namespace
}  // namespace tanglebin
