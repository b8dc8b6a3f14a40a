#include "tanglebin/scan/sensor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tests/support/complaint.hpp"

namespace tanglebin {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string complaint(const Sensor& sensor) {
  return test::complaint([&] { validate(sensor); });
}

TEST(Sensor, IsIdealUnlessATermIsSwitchedOn) {
  EXPECT_TRUE(is_ideal({}));
  EXPECT_TRUE(is_ideal({.baseline = 0.3, .snr = 5, .gloss_max = 2})) << "parameters of terms that are off";
  EXPECT_FALSE(is_ideal({.sigma = 0.001}));
  EXPECT_FALSE(is_ideal({.dropout = 0.001}));
  EXPECT_FALSE(is_ideal({.edges = Edges::mix}));
  EXPECT_FALSE(is_ideal({.shadows = true}));
  EXPECT_FALSE(is_ideal({.signal = true}));
  EXPECT_FALSE(is_ideal({.disparity_sigma = 0.1}));
  EXPECT_FALSE(is_ideal({.trueness = 0.001}));
  EXPECT_FALSE(is_ideal({.kinect_noise = true}));
  EXPECT_FALSE(is_ideal({.quantization = 0.0001}));
  EXPECT_FALSE(is_ideal({.fill = 1}));
  EXPECT_FALSE(is_ideal({.median = 3}));
  EXPECT_TRUE(is_ideal({.column_correlation = 0.5})) << "of a noise that is off";
}

TEST(Sensor, PresetsAreValidAndOnlyThePapersIsIdeal) {
  for (const std::string_view name : scanner_presets()) {
    EXPECT_EQ(complaint(sensor_preset(name)), "none") << name;
    EXPECT_EQ(is_ideal(sensor_preset(name)), name == "paper") << name;
  }
  EXPECT_EQ(test::complaint([] { sensor_preset("eye"); }), test::complaint([] { camera_preset("eye"); }));
  EXPECT_THAT(test::complaint([] { sensor_preset("eye"); }), HasSubstr("found 'eye'"));
}

TEST(Sensor, NamesTheKeyThatMakesNoSenseAndTheRemedy) {
  EXPECT_THAT(complaint({.sigma = -1}),
              StartsWith("scanner.sigma: found -1, expected 0 to 1 m; 0 is no noise"));
  EXPECT_THAT(complaint({.dropout = 1}), StartsWith("scanner.dropout: found 1, expected a fraction"));
  EXPECT_THAT(complaint({.baseline = 0}),
              StartsWith("scanner.baseline: found 0, expected a distance in metres other than 0"));
  EXPECT_EQ(complaint({.baseline = -0.3}), "none") << "the projector is on the image's left";
  EXPECT_THAT(complaint({.column_correlation = 1}),
              StartsWith("scanner.column_correlation: found 1, expected a correlation from 0 to below 1"));
  EXPECT_THAT(complaint({.quantization = -1}), StartsWith("scanner.quantization: found -1"));
  EXPECT_THAT(complaint({.fill = -1}), StartsWith("scanner.fill: found -1"));
  EXPECT_THAT(complaint({.median = 4}),
              StartsWith("scanner.median: found 4, expected an odd number of pixels from 3 to 31"));
  EXPECT_THAT(complaint({.median = -3}), StartsWith("scanner.median: found -3"));
  EXPECT_THAT(complaint({.median = 1}), StartsWith("scanner.median: found 1"));
  EXPECT_THAT(complaint({.baseline = 0}), HasSubstr("shadows = false"));
  EXPECT_THAT(complaint({.working_distance = 0}), StartsWith("scanner.working_distance: found 0"));
  EXPECT_THAT(complaint({.snr = -2}), StartsWith("scanner.snr: found -2, expected a positive ratio"));
  EXPECT_THAT(complaint({.snr_min = 3}),
              StartsWith("scanner.snr_min: found 3, expected at most snr_max = 2.5, or a higher snr_max"));
  EXPECT_THAT(complaint({.albedo_min = 0.9}), StartsWith("scanner.albedo_min: found 0.9, expected at most"));
  EXPECT_THAT(complaint({.albedo_max = 1.5}), StartsWith("scanner.albedo_max: found 1.5"));
  EXPECT_THAT(complaint({.gloss_min = 2}), StartsWith("scanner.gloss_min: found 2"));
  EXPECT_THAT(complaint({.shininess = 0}), StartsWith("scanner.shininess: found 0"));
  EXPECT_THAT(complaint({.bin_albedo = -0.1}), StartsWith("scanner.bin_albedo: found -0.1"));
  EXPECT_THAT(complaint({.bin_gloss = -0.1}), StartsWith("scanner.bin_gloss: found -0.1"));
  EXPECT_THAT(complaint({.footprint = 0}), StartsWith("scanner.footprint: found 0"));
  EXPECT_THAT(complaint({.sub_rays = 1}), StartsWith("scanner.sub_rays: found 1, expected 2 to 16"));
  EXPECT_THAT(complaint({.edge_jump = 0}), StartsWith("scanner.edge_jump: found 0"));
  EXPECT_THAT(complaint({.disparity_sigma = -1}), StartsWith("scanner.disparity_sigma: found -1"));
  EXPECT_THAT(complaint({.trueness = -1}), StartsWith("scanner.trueness: found -1"));
  EXPECT_THAT(complaint({.trueness_length = 0}), StartsWith("scanner.trueness_length: found 0"));
  EXPECT_THAT(complaint({.sigma = std::numeric_limits<double>::quiet_NaN()}), HasSubstr("found nan"));
}

TEST(Sensor, NamesTheEndOfARangeThatWasSet) {
  EXPECT_THAT(complaint({.snr_max = 0.1}),
              StartsWith("scanner.snr_max: found 0.1, expected at least snr_min = 0.15, or a lower snr_min"));
  EXPECT_THAT(complaint({.albedo_max = 0.2}), StartsWith("scanner.albedo_max: found 0.2, expected at least"));
  EXPECT_THAT(complaint({.gloss_max = 0}), StartsWith("scanner.gloss_max: found 0, expected at least"));
  EXPECT_EQ(complaint({.gloss_min = 0, .gloss_max = 0}), "none");
  EXPECT_THAT(complaint({.snr_min = 0.6, .snr_max = 0.5}),
              StartsWith("scanner.snr_min: found 0.6, expected at most snr_max = 0.5"));
  EXPECT_THAT(complaint({.snr_min = 3, .snr_max = -1}),
              StartsWith("scanner.snr_max: found -1, expected a positive ratio"))
      << "what is wrong by itself comes first";
  EXPECT_THAT(complaint({.gloss_max = -1}), StartsWith("scanner.gloss_max: found -1, expected a highlight"));
}

TEST(Sensor, RefusesWhatNoScannerHas) {
  EXPECT_THAT(complaint({.sigma = 1e300}),
              StartsWith("scanner.sigma: found 1e+300, expected 0 to 1 m; 0 is no noise"));
  EXPECT_THAT(complaint({.disparity_sigma = 101}), HasSubstr("expected 0 to 100 pixels; 0 is no noise"));
  EXPECT_THAT(complaint({.trueness = 1.1}), HasSubstr("expected 0 to 1 m; 0 is no error"));
  EXPECT_THAT(complaint({.trueness_length = 0.5}), HasSubstr("at least 1 pixel"));
}

TEST(Sensor, AScanRefusesACameraAsItDoesASensor) {
  Camera camera = camera_preset("paper");
  camera.fx = 0;
  const auto expected = StartsWith("scanner.fx: found 0");
  EXPECT_THAT(test::complaint([&] { scan({}, Bin{}, camera); }), expected);
  EXPECT_THAT(test::complaint([&] { scan({}, Bin{}, camera, {.sigma = 0.001}, 1); }), expected);
}

}  // namespace
}  // namespace tanglebin
