#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

// Internal to the room.
namespace tanglebin {

/// Finds the few of many boxes that a point may lie in.
class BoxGrid {
public:
  /// Takes boxes in m, with finite corners.
  explicit BoxGrid(const std::vector<Eigen::AlignedBox3d>& boxes);

  /// Indices of boxes, ascending: at least all that contain the point (m).
  const std::vector<std::uint32_t>& around(const Eigen::Vector3d& point) const;

private:
  Eigen::Vector3i cell_of(const Eigen::Vector3d& point) const;
  std::size_t index_of(const Eigen::Vector3i& cell) const;
  void add(std::uint32_t index, const Eigen::AlignedBox3d& box);

  Eigen::AlignedBox3d bounds_;
  Eigen::Vector3d cell_;                           // m, the size of a cell
  Eigen::Vector3i counts_;                         // of cells
  std::vector<std::vector<std::uint32_t>> cells_;  // which boxes touch each
  std::vector<std::uint32_t> none_;
};

}  // namespace tanglebin
