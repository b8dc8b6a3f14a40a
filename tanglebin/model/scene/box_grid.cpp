#include "tanglebin/model/scene/box_grid.hpp"

#include <cmath>

namespace tanglebin {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using Eigen::Vector3i;

// A cell is about as large as a box, but there are never many.
BoxGrid::BoxGrid(const std::vector<AlignedBox3d>& boxes) {
  Vector3d sum = Vector3d::Zero();
  for (const AlignedBox3d& box : boxes) {
    bounds_.extend(box);
    sum += box.sizes();
  }
  if (boxes.empty()) return;
  constexpr double most_cells = 1 << 16;
  const double least = std::cbrt(bounds_.volume() / most_cells);
  cell_ = (sum / static_cast<double>(boxes.size())).cwiseMax(least);
  counts_ = bounds_.sizes().cwiseQuotient(cell_).cast<int>() + Vector3i::Ones();
  cells_.resize(static_cast<std::size_t>(counts_.prod()));
  for (std::uint32_t i = 0; i < boxes.size(); ++i) add(i, boxes[i]);
}

const std::vector<std::uint32_t>& BoxGrid::around(const Vector3d& point) const {
  return bounds_.contains(point) ? cells_[index_of(cell_of(point))] : none_;
}

void BoxGrid::add(std::uint32_t index, const AlignedBox3d& box) {
  const Vector3i first = cell_of(box.min());
  const Vector3i last = cell_of(box.max());
  Vector3i cell;
  for (cell.z() = first.z(); cell.z() <= last.z(); ++cell.z()) {
    for (cell.y() = first.y(); cell.y() <= last.y(); ++cell.y()) {
      for (cell.x() = first.x(); cell.x() <= last.x(); ++cell.x()) cells_[index_of(cell)].push_back(index);
    }
  }
}

// Rounding keeps the order of numbers, so a point in a box is in one of the cells from its least corner's to
// its greatest's.
Vector3i BoxGrid::cell_of(const Vector3d& point) const {
  return (point - bounds_.min()).cwiseQuotient(cell_).cast<int>();
}

std::size_t BoxGrid::index_of(const Vector3i& cell) const {
  const Eigen::Matrix<std::size_t, 3, 1> place = cell.cast<std::size_t>();
  const Eigen::Matrix<std::size_t, 3, 1> counts = counts_.cast<std::size_t>();
  return (place.z() * counts.y() + place.y()) * counts.x() + place.x();
}

}  // namespace tanglebin
