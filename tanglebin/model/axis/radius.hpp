#pragma once

#include <cstddef>
#include <functional>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// The radii to choose from, m.
struct RadiusRange {
  double min = 0.002;
  double max = 0.060;
};

/// The one radius of all tubes in a cloud, m.
struct RadiusEstimate {
  double radius;
  double standard_error;  ///< of the radius, without what is wrong with the sensor as a whole
  double scatter;         ///< standard deviation of the radius from place to place
  int rounds;             ///< until it changed by less than its error
  std::size_t places;     ///< a diameter or more apart, that show the radius
};

/// Estimates the one radius of all tubes in a cloud by fitting cylinders to small pieces of the surface.
/// Planes and balls do not count, so the support need not be known. Arguments as for model_tubes();
/// known.kinds is ignored. Throws InputError naming `radius` if the range is empty or outside of what
/// known_scene.hpp allows, or if the cloud does not show one radius within it: too few points, too few of
/// them on a tube, only flat surfaces, or tubes of several radii. Calls `at_place` before each place that it
/// looks at; what it throws ends the estimate.
RadiusEstimate estimate_radius(
    const PointCloud& cloud, const KnownScene& known, const RadiusRange& range = {},
    const std::function<void()>& at_place = [] {});

}  // namespace tanglebin
