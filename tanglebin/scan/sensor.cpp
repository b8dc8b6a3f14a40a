#include "tanglebin/scan/sensor.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {
namespace {

constexpr int most_sub_rays = 16;
constexpr double largest_footprint = 9;          // pixels
constexpr double largest_error = 1;              // m
constexpr int largest_median = 31;               // pixels
constexpr double largest_disparity_sigma = 100;  // pixels

[[noreturn]] void fail(const std::string& key, double value, const std::string& expected) {
  throw InputError({.file = "", .line = 0, .field = "scanner." + key}, fmt::format("{}", value), expected);
}

void require_positive(double value, const char* key, const std::string& expected) {
  if (!(std::isfinite(value) && value > 0)) fail(key, value, expected);
}

void require_not_negative(double value, const char* key, const std::string& expected) {
  if (!(std::isfinite(value) && value >= 0)) fail(key, value, expected);
}

void require_within(double value, double least, double greatest, const char* key,
                    const std::string& expected) {
  if (!(value >= least && value <= greatest)) fail(key, value, expected);
}

/// Checks that a range is in order. The error names the end that differs from its default.
void require_order(const Sensor& sensor, double Sensor::*least, double Sensor::*greatest,
                   const std::string& least_key, const std::string& greatest_key) {
  if (sensor.*least <= sensor.*greatest) return;
  if (sensor.*least == Sensor{}.*least) {
    fail(greatest_key, sensor.*greatest,
         fmt::format("at least {} = {}, or a lower {}", least_key, sensor.*least, least_key));
  }
  fail(least_key, sensor.*least,
       fmt::format("at most {} = {}, or a higher {}", greatest_key, sensor.*greatest, greatest_key));
}

void validate_noise(const Sensor& sensor) {
  require_within(sensor.sigma, 0, largest_error, "sigma",
                 fmt::format("0 to {} m; 0 is no noise", largest_error));
  if (!(sensor.dropout >= 0 && sensor.dropout < 1)) {
    fail("dropout", sensor.dropout, "a fraction of the pixels, from 0 to below 1");
  }
  require_within(sensor.disparity_sigma, 0, largest_disparity_sigma, "disparity_sigma",
                 fmt::format("0 to {} pixels; 0 is no noise", largest_disparity_sigma));
  require_within(sensor.trueness, 0, largest_error, "trueness",
                 fmt::format("0 to {} m; 0 is no error", largest_error));
  if (!(sensor.column_correlation >= 0 && sensor.column_correlation < 1)) {
    fail("column_correlation", sensor.column_correlation, "a correlation from 0 to below 1");
  }
  if (!(std::isfinite(sensor.trueness_length) && sensor.trueness_length >= 1)) {
    fail("trueness_length", sensor.trueness_length, "at least 1 pixel; trueness = 0 switches the term off");
  }
}

void validate_footprint(const Sensor& sensor) {
  if (!(sensor.footprint > 0 && sensor.footprint <= largest_footprint)) {
    fail("footprint", sensor.footprint,
         fmt::format("more than 0 and at most {} pixels; edges = \"keep\" switches the term off",
                     largest_footprint));
  }
  if (sensor.sub_rays < 2 || sensor.sub_rays > most_sub_rays) {
    fail("sub_rays", sensor.sub_rays,
         fmt::format("2 to {}; edges = \"keep\" is a single ray", most_sub_rays));
  }
  require_positive(sensor.edge_jump, "edge_jump", "a positive difference in depth in metres");
}

void validate_projector(const Sensor& sensor) {
  if (!std::isfinite(sensor.baseline) || sensor.baseline == 0) {
    fail("baseline", sensor.baseline,
         "a distance in metres other than 0; a scanner without a projector has shadows = false and "
         "disparity_sigma = 0");
  }
  require_positive(sensor.working_distance, "working_distance", "a positive distance in metres");
}

void validate_signal(const Sensor& sensor) {
  const char* const reflectance = "a reflectance from 0 to 1";
  const char* const highlight = "a highlight of 0 or more";
  require_positive(sensor.snr, "snr", "a positive ratio; signal = false switches the term off");
  require_not_negative(sensor.snr_min, "snr_min", "a ratio of 0 or more; 0 keeps all weak pixels");
  require_positive(sensor.snr_max, "snr_max", "a positive ratio; a large one keeps all bright pixels");
  require_order(sensor, &Sensor::snr_min, &Sensor::snr_max, "snr_min", "snr_max");
  require_within(sensor.albedo_min, 0, 1, "albedo_min", reflectance);
  require_within(sensor.albedo_max, 0, 1, "albedo_max", reflectance);
  require_order(sensor, &Sensor::albedo_min, &Sensor::albedo_max, "albedo_min", "albedo_max");
  require_not_negative(sensor.gloss_min, "gloss_min", highlight);
  require_not_negative(sensor.gloss_max, "gloss_max", highlight);
  require_order(sensor, &Sensor::gloss_min, &Sensor::gloss_max, "gloss_min", "gloss_max");
  require_positive(sensor.shininess, "shininess",
                   "a positive exponent; gloss_min = 0 and gloss_max = 0 switch highlights off");
  require_within(sensor.bin_albedo, 0, 1, "bin_albedo", reflectance);
  require_not_negative(sensor.bin_gloss, "bin_gloss", highlight);
}

void validate_image(const Sensor& sensor) {
  require_within(sensor.quantization, 0, largest_error, "quantization",
                 fmt::format("a step of at most {} metre, or 0 for none", largest_error));
  if (sensor.fill < 0) fail("fill", sensor.fill, "a number of pixels, or 0 to fill no gaps");
  const bool is_odd = sensor.median % 2 == 1;
  if (sensor.median != 0 && (!is_odd || sensor.median < 3 || sensor.median > largest_median)) {
    fail("median", sensor.median,
         fmt::format("an odd number of pixels from 3 to {}, or 0 for none", largest_median));
  }
}

}  // namespace

bool is_ideal(const Sensor& sensor) {
  return sensor.sigma == 0 && sensor.dropout == 0 && sensor.edges == Edges::keep && !sensor.shadows &&
         !sensor.signal && sensor.disparity_sigma == 0 && sensor.trueness == 0 && !sensor.kinect_noise &&
         sensor.quantization == 0 && sensor.fill == 0 && sensor.median == 0;
}

Sensor sensor_preset(std::string_view name) {
  if (name == "gaussian") return {.sigma = 0.0005, .dropout = 0.02, .edges = Edges::drop};
  if (name == "zivid-one-plus-l") {
    return {.dropout = 0.002,
            .edges = Edges::mix,
            .shadows = true,
            .signal = true,
            .disparity_sigma = 0.04,
            .trueness = 0.0003};
  }
  if (name == "kinect-v1") return {.kinect_noise = true};
  if (name == "phoxi") {
    return {.sigma = 0.0005,
            .column_correlation = 0.5,
            .edges = Edges::mix,
            .footprint = 3,
            .sub_rays = 4,
            .edge_jump = 0.002,
            .shadows = true,
            .baseline = -0.32,
            .working_distance = 1.2,
            .signal = true,
            .snr_min = 0.06,
            .quantization = 0.00039,
            .fill = 5,
            .median = 5};
  }
  camera_preset(name);  // throws if the name is unknown
  return {};
}

void validate(const Sensor& sensor) {
  validate_noise(sensor);
  validate_footprint(sensor);
  validate_projector(sensor);
  validate_signal(sensor);
  validate_image(sensor);
}

}  // namespace tanglebin
