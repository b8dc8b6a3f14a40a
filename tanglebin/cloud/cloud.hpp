#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace tanglebin {

using Color = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// A point cloud as arrays of equal length. An optional array is empty if the cloud does not have that
/// property. Organized clouds have width * height points, row by row, with NaN for missing ones; others have
/// height 1.
struct PointCloud {
  std::vector<Eigen::Vector3f> points;     ///< m, world frame
  std::vector<std::int32_t> labels;        ///< optional: 0 = bin, 1..n = tubes, −1 = null
  std::vector<Color> colors;               ///< optional
  std::vector<Eigen::Vector3f> normals{};  ///< optional: outward unit normals of the true surface
  std::vector<float> intensities{};        ///< optional: signal-to-noise ratio
  std::vector<std::uint8_t> mixed{};       ///< optional: 1 for a mixed point, the mean of several surfaces
  std::size_t width = 0;
  std::size_t height = 1;
  std::optional<Eigen::Isometry3d> viewpoint;  ///< sensor frame → world frame, if known
  std::optional<double> depth_scale{};         ///< steps per metre, if it was a depth image of integers
};

/// Throws std::invalid_argument if the arrays differ in length, if there are not width * height points, or if
/// a label is below −1.
void check_cloud(const PointCloud& cloud);

}  // namespace tanglebin
