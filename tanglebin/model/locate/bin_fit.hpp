#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/model/locate/bin_parts.hpp"
#include "tanglebin/model/locate/sensor_view.hpp"

// Internal to the room.
namespace tanglebin {

/// What a bin is fitted to.
struct BinToFit {
  Bin bin;        ///< nominal sizes
  double margin;  ///< m, by which the real bin may deviate
  double noise;   ///< m, RMS distance of points from their surface
};

/// So near to a surface of the bin (m), points are on it.
double closeness_of(const BinToFit& known);

/// The points on a surface of the bin.
struct PartFit {
  int points = 0;
  double noise = 0;  ///< m, robust standard deviation of their distance
};

/// A bin fitted to a view.
struct BinFit {
  Eigen::Isometry3d pose;  ///< bin frame → camera frame
  Bin sizes;               ///< as the points have them, as far as they do; else nominal
  double residual = 0;     ///< m, RMS distance of the points on its surfaces
  std::array<PartFit, part_count> parts{};
  int edges = 0;                  ///< pixels at which the rim ends
  bool is_wall_measured = false;  ///< whether its thickness was seen; else it is nearly as given
  /// Of translation (m) and rotation (rad) in the bin's frame, if its floor is as even as rim and walls.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  double floor_variance = 0;  ///< m², of the height, because the floor is less even
};

/// Moves a bin by a few centimetres and degrees onto the surfaces seen. Rough.
Eigen::Isometry3d moved_near(const SensorView& view, const BinToFit& known, const Eigen::Isometry3d& pose);

/// Fits a bin that is near its place already: least squares over points on its surfaces and the edges of its
/// rim, with the sizes free within millimetres, and without outliers such as tubes.
BinFit fit_bin(const SensorView& view, const BinToFit& known, const Eigen::Isometry3d& pose);

}  // namespace tanglebin
