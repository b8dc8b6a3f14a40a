#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/model/axis/settings/axis_settings.hpp"

namespace tanglebin {

/// A point between two surfaces is a mean of both. It has more of the one that is nearer to it in depth.
struct BlendedPoint {
  std::size_t point;
  std::size_t end;  ///< the point at an end of its ramps that is nearest in depth
};

/// What a scanner makes of the edges of surfaces.
struct Ramps {
  std::vector<bool>
      points;      ///< for each point: whether it is on a ramp, or so near that it may be bent by it
  double blended;  ///< share of the edges with a point half-way between their two surfaces
  std::vector<BlendedPoint> between;  ///< those of the points that are between two surfaces
};

/// Finds ramps. A scanner that averages over an edge leaves a few points between the near surface and the far
/// one, in a row or a column of the image: a run of steep steps in one direction, over more depth than the
/// flank of the thickest tube has. Points and radii are in m, the points in the frame of the camera's pose.
/// Where neighbouring pixels have no points, there are no ramps, and none where the thinnest tube has so few
/// pixels that its flank looks like one.
Ramps find_ramps(const std::vector<Eigen::Vector3f>& points, const Camera& camera, double thinnest,
                 double thickest, const RampSettings& settings);

}  // namespace tanglebin
