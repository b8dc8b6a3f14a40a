#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/camera.hpp"

// Internal to the room: clouds as images.
namespace tanglebin {

/// Whether the cloud's points are in the order of an image's pixels.
inline bool is_organized(const PointCloud& cloud) {
  return cloud.width > 1 && cloud.height > 1;
}

/// A camera that was found from an organized cloud.
struct FittedIntrinsics {
  Intrinsics intrinsics;
  double residual;  ///< pixels, RMS of the points' projections from their pixels
};

/// The pinhole camera whose pixels the points of an organized cloud are in, by least squares. `motion` moves
/// the points into the camera's frame. None if too few points are in front of the camera, or in too small a
/// part of the image.
std::optional<FittedIntrinsics> fit_intrinsics(const PointCloud& cloud, const Eigen::Isometry3d& motion);

/// Whether an organized cloud is a pinhole camera's image: its points are within half a percent of the
/// image's diagonal of their pixels, as those of an image with some distortion are.
bool is_image(const FittedIntrinsics& fitted);

/// Whether it is the image the right way up, with x to the right and y down.
bool fits(const FittedIntrinsics& fitted);

/// The share of the cloud's finite points, in [0, 1], that are in front of the camera and in its image.
/// `motion` moves them into the camera's frame; it includes the unit. Looks at about ten thousand of them. 0
/// if there are none.
double share_in_image(const PointCloud& cloud, const Eigen::Affine3d& motion, const Intrinsics& intrinsics);

/// The share of the cloud's finite points, in [0, 1], that are behind the camera. `motion` moves them into
/// the camera's frame. Looks at about ten thousand of them. 0 if there are none.
double share_behind(const PointCloud& cloud, const Eigen::Isometry3d& motion);

/// The longest extent of the cloud along an axis, without a hundredth of the points at either end, in its own
/// unit. Looks at about ten thousand points. None if none is finite.
std::optional<double> extent(const PointCloud& cloud);

}  // namespace tanglebin
