#pragma once

#include <cstdint>
#include <vector>

#include "tanglebin/base/counter_random.hpp"
#include "tanglebin/scan/scan.hpp"
#include "tanglebin/scan/sensor.hpp"

namespace tanglebin {

// Internal to the room: how far off a measured range is.

/// m, in depth, of a fronto-parallel disparity's standard deviation (docs/sensor.md).
double disparity_depth_sigma(const Sensor& sensor, const Camera& camera, double depth, double snr);

/// Nguyen, Izadi and Lovell 2012: standard deviation of the depth, m, and of the place in the image, pixels,
/// of a surface at a depth (m) seen at an angle (rad) from its normal. Angles above 85° count as 85°.
double kinect_axial_sigma(double depth, double incidence);
double kinect_lateral_sigma(double incidence);

/// The smooth error of calibration of the pixels of a window, m along their rays, row by row.
std::vector<float> trueness_errors(const Sensor& sensor, const PixelWindow& window, std::uint64_t seed);

/// The random error of a range.
class RangeNoise {
public:
  RangeNoise(const Sensor& sensor, const Camera& camera, std::uint64_t seed);

  /// m along the ray, of the pixel with this number, whose ray makes an angle with the optical axis.
  double draw(std::uint64_t pixel, double depth, double incidence, double snr, double axial_cosine) const;

private:
  const Sensor& sensor_;
  const Camera& camera_;
  CounterRandom range_;
  CounterRandom disparity_;
  CounterRandom kinect_;
};

}  // namespace tanglebin
