#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace tanglebin {

/// The grid cell that contains a position; position and cell size in metres.
inline Eigen::Vector3i voxel_at(const Eigen::Vector3d& position, double size) {
  return (position / size).array().floor().cast<int>();
}

/// A grid cell as a single number. Coordinates range from −2²⁰ to 2²⁰ − 1.
inline std::uint64_t voxel_key(const Eigen::Vector3i& cell) {
  constexpr int bits = 21;
  constexpr int offset = 1 << (bits - 1);
  std::uint64_t key = 0;
  for (const int coordinate : cell) key = (key << bits) | static_cast<std::uint64_t>(coordinate + offset);
  return key;
}

}  // namespace tanglebin
