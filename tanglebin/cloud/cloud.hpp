#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace tanglebin {

using Color = std::array<std::uint8_t, 3>;  ///< red, green, blue

/// A point cloud as arrays of equal length; an optional array is empty where the cloud has no such property.
/// Organized (width * height points, row by row, NaN where there is none) or not (height 1).
struct PointCloud {
  std::vector<Eigen::Vector3f> points;     ///< m, world frame
  std::vector<std::int32_t> labels;        ///< optional: 0 the bin, 1..n the tubes, −1 null
  std::vector<Color> colors;               ///< optional
  std::vector<Eigen::Vector3f> normals{};  ///< optional: of the true surface, outward unit vectors
  std::vector<float> intensities{};        ///< optional: the signal-to-noise ratio
  std::vector<std::uint8_t> mixed{};       ///< optional: 1 for a point that is the mean of several surfaces
  std::size_t width = 0;
  std::size_t height = 1;
  std::optional<Eigen::Isometry3d> viewpoint;  ///< sensor frame → world frame, where known
};

/// Throws std::invalid_argument for arrays of different lengths, other than width * height points, or a label
/// below −1.
void check_cloud(const PointCloud& cloud);

}  // namespace tanglebin
