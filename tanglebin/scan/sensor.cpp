#include "tanglebin/scan/sensor.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/scan/camera.hpp"

namespace tanglebin {
namespace {

constexpr int most_sub_rays = 16;
constexpr double largest_footprint = 9;  // pixels

[[noreturn]] void fail(const std::string& key, double value, const std::string& expected) {
  throw InputError({.file = "", .line = 0, .field = "scanner." + key}, fmt::format("{}", value), expected);
}

void require_positive(double value, const char* key, const std::string& expected) {
  if (!(std::isfinite(value) && value > 0)) fail(key, value, expected);
}

void require_not_negative(double value, const char* key, const std::string& expected) {
  if (!(std::isfinite(value) && value >= 0)) fail(key, value, expected);
}

void require_order(double least, double greatest, const std::string& least_key,
                   const std::string& greatest_key) {
  if (!(least <= greatest)) {
    fail(least_key, least, fmt::format("at most {} = {}: exchange the two", greatest_key, greatest));
  }
}

void validate_noise(const Sensor& sensor) {
  require_not_negative(sensor.sigma, "sigma", "metres of noise, or 0 for none");
  if (!(sensor.dropout >= 0 && sensor.dropout < 1)) {
    fail("dropout", sensor.dropout, "a share of the pixels from 0 to less than 1");
  }
  require_not_negative(sensor.disparity_sigma, "disparity_sigma", "pixels of noise, or 0 for none");
  require_not_negative(sensor.trueness, "trueness", "metres of error, or 0 for none");
  require_positive(sensor.trueness_length, "trueness_length",
                   "a positive number of pixels; trueness = 0 switches the term off");
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
  require_positive(sensor.baseline, "baseline",
                   "a positive distance in metres; a scanner without a projector has shadows = false and "
                   "disparity_sigma = 0");
  require_positive(sensor.working_distance, "working_distance", "a positive distance in metres");
}

void validate_signal(const Sensor& sensor) {
  require_positive(sensor.snr, "snr", "a positive ratio; signal = false switches the term off");
  require_not_negative(sensor.snr_min, "snr_min", "a ratio, or 0 to lose no weak pixel");
  require_order(sensor.snr_min, sensor.snr_max, "snr_min", "snr_max");
  require_not_negative(sensor.albedo_min, "albedo_min", "a reflectance from 0 to 1");
  require_order(sensor.albedo_min, sensor.albedo_max, "albedo_min", "albedo_max");
  if (!(sensor.albedo_max <= 1)) fail("albedo_max", sensor.albedo_max, "a reflectance from 0 to 1");
  require_not_negative(sensor.gloss_min, "gloss_min", "a highlight of 0 or more");
  require_order(sensor.gloss_min, sensor.gloss_max, "gloss_min", "gloss_max");
  require_positive(sensor.shininess, "shininess",
                   "a positive exponent; gloss_max = 0 switches highlights off");
  if (!(sensor.bin_albedo >= 0 && sensor.bin_albedo <= 1)) {
    fail("bin_albedo", sensor.bin_albedo, "a reflectance from 0 to 1");
  }
  require_not_negative(sensor.bin_gloss, "bin_gloss", "a highlight of 0 or more");
}

}  // namespace

bool is_ideal(const Sensor& sensor) {
  return sensor.sigma == 0 && sensor.dropout == 0 && sensor.edges == Edges::keep && !sensor.shadows &&
         !sensor.signal && sensor.disparity_sigma == 0 && sensor.trueness == 0 && !sensor.kinect_noise;
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
  camera_preset(name);  // throws for an unknown name
  return {};
}

void validate(const Sensor& sensor) {
  validate_noise(sensor);
  validate_footprint(sensor);
  validate_projector(sensor);
  validate_signal(sensor);
}

}  // namespace tanglebin
