#pragma once

#include <Eigen/Core>
#include <numbers>
#include <string>
#include <vector>

#include "tanglebin/geometry/camera.hpp"

namespace tanglebin {

/// The direction and size of a picture.
struct View {
  double azimuth = -std::numbers::pi / 3;   ///< rad, of the viewer, about z, from +x towards +y
  double elevation = std::numbers::pi / 4;  ///< rad, of the viewer, above the horizontal, in [−π/2, π/2]
  int width = 1200;                         ///< pixels, in [1, largest_picture]
  int height = 900;                         ///< pixels, in [1, largest_picture]
};

inline constexpr int largest_picture = 4096;  ///< pixels per side; drawing a square one takes 4 GB

/// Throws InputError naming the invalid field.
void validate(const View& view);

/// The largest coordinate that can be drawn, m.
inline constexpr double farthest_in_picture = 1e7;

/// A camera that looks in the view's direction, as near as possible with all `points` (m, at least one) in
/// the image. The image has `scale` times the view's pixels on each side. Throws InputError with `name` for a
/// point beyond farthest_in_picture.
Camera camera_for(const View& view, int scale, const std::vector<Eigen::Vector3d>& points,
                  const std::string& name);

}  // namespace tanglebin
