#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/support.hpp"

namespace tanglebin {

/// A surface of the support that was seen.
struct LocatedPart {
  std::string name;  ///< "floor", "rim" or "the wall at +x"
  int points;        ///< of those that the fit used
  double noise;      ///< m, robust standard deviation of their distance from it
};

/// A support found in a cloud.
struct Located {
  Support support;  ///< as given, with the pose found: support frame → world frame
  /// Standard deviations in the support's frame: of its origin, m, and about its axes, rad. For a plane, only
  /// z and the rotations about x and y have any: the others are chosen, not found.
  Eigen::Vector3d position_sd;
  Eigen::Vector3d rotation_sd;
  double residual;  ///< m, RMS distance of the points on the support from its surfaces
  /// Of the points whose line of sight meets the support: the shares on it and behind it. The others are in
  /// front: tubes.
  double explained;
  double contradicted;
  Bin measured;  ///< a bin's inner sizes and wall, as the points have them; as given where none were seen
  bool is_wall_measured;  ///< whether measured.wall was seen; else it is nearly as given
  std::vector<LocatedPart> parts;
};

/// Finds the pose of a support of known shape and sizes in a cloud (m, world frame), of which the camera saw
/// every point. The more the cloud has of the support itself, the better: floor, walls, and the top of the
/// rim. Tubes may hide most of the floor. The bin need not be level, and its yaw may be anything.
///
/// A bin looks the same turned by 180° (by 90° too if it is square): of these poses, the result is the one
/// nearest to support.pose. Of several bins of these sizes, it is the one that is much nearer to support.pose
/// than the others. Otherwise that pose does not matter for a bin. A plane is the lowest large one; its z
/// axis points to the camera's side, its origin is that of support.pose, moved onto the plane, and its x axis
/// that of support.pose, turned into the plane.
///
/// Deterministic. Throws InputError as validate(Support) does, and naming `cloud` or `support` where the
/// support is not found, or not surely: too few points in the image, a wall or the rim is not where the sizes
/// have it, two poses fit equally well, the position is not determined by what was seen, the best plane cuts
/// through the tubes. Names `support.position` where there are several bins and none is much nearer.
Located locate(const PointCloud& cloud, const Support& support, const Camera& camera);

}  // namespace tanglebin
