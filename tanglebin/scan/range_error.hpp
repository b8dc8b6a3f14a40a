#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/base/counter_random.hpp"
#include "tanglebin/scan/scan.hpp"
#include "tanglebin/scan/sensor.hpp"

namespace tanglebin {

// Internal to the room: errors of a measured range.

/// Standard deviation of the depth, m, that results from disparity noise on a fronto-parallel surface
/// (docs/sensor.md).
double disparity_depth_sigma(const Sensor& sensor, const Camera& camera, double depth, double snr);

/// Kinect noise (Nguyen, Izadi and Lovell 2012): standard deviation of the depth, m, and of the lateral
/// position, pixels, for a surface at a depth (m) seen at an angle (rad) from its normal. Angles above 85°
/// count as 85°.
double kinect_axial_sigma(double depth, double incidence);
double kinect_lateral_sigma(double incidence);

/// The smooth calibration error of each pixel in a window, m along its ray, row by row.
std::vector<float> trueness_errors(const Sensor& sensor, const PixelWindow& window, std::uint64_t seed);

/// The random error of a range.
class RangeNoise {
public:
  RangeNoise(const Sensor& sensor, const Camera& camera, const PixelWindow& window, std::uint64_t seed);

  /// The error of the pixel with this index in the image and `place` in the window, m along its ray.
  /// `axial_cosine` is the cosine of the angle between the ray and the optical axis.
  double draw(std::uint64_t pixel, std::size_t place, double depth, double incidence, double snr,
              double axial_cosine) const;

private:
  const Sensor& sensor_;
  const Camera& camera_;
  std::vector<double> range_;  ///< of each pixel of the window, standard normal
  CounterRandom disparity_;
  CounterRandom kinect_;
};

}  // namespace tanglebin
