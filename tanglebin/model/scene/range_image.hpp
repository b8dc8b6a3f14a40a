#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {

/// The range that the camera measured in each pixel, from points that it saw.
class RangeImage {
public:
  /// Points are in m, world frame. Those that are not finite or not in the image are left out. `solid` is
  /// where no tube can be.
  RangeImage(const std::vector<Eigen::Vector3f>& points, const Camera& camera,
             std::vector<Eigen::AlignedBox3d> solid = {});

  /// One more point that the camera saw.
  void add(const Eigen::Vector3f& point);

  /// True if the camera saw something nearer than the farther of two points (m, world frame) within `radius`
  /// pixels of the midpoint of their projections. False if a point is not in front of the camera.
  bool hides(const Eigen::Vector3d& first, const Eigen::Vector3d& second, int radius) const;

  /// True if the camera looked past the axis of a tube of this radius (m) at this point: within a third of a
  /// radius around it, something was seen, and all of it lies behind the tube's surface. True too if the axis
  /// is within half a radius of what is solid.
  bool shows_empty(const Eigen::Vector3d& axis, double radius) const;

  /// True if the axis of a tube of this radius (m) is within half a radius of what is solid.
  bool is_solid(const Eigen::Vector3d& axis, double radius) const;

  /// True if a ball of this radius (m) around the point is wholly in the camera's view.
  bool covers(const Eigen::Vector3d& point, double radius) const;

  /// Gives back the memory of the rows above and below all that was measured. Answers stay the same.
  void keep_measured_rows();

private:
  enum class Seen { nothing, farther, nearer };

  // What was seen within `reach` pixels of a place in the image: anything nearer than `near`, m, or only what
  // is farther.
  Seen seen_around(const Eigen::Vector2d& middle, double reach, double near) const;

  Camera camera_;
  std::vector<Eigen::AlignedBox3d> solid_;
  std::ptrdiff_t first_row_ = 0;  ///< that is kept
  std::ptrdiff_t end_row_;        ///< one past the last of these
  std::vector<float> depths_;     ///< m, of the nearest point, row by row; ∞ where there is none
};

}  // namespace tanglebin
