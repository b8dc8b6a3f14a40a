#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/scan/sensor.hpp"
#include "tanglebin/scan/tile_index.hpp"

namespace tanglebin {

// Internal to the room.

/// The projector as a camera: its pose, and an image that covers what it lights.
Camera projector_beside(const Camera& camera, const Sensor& sensor);

/// Determines which points the projector lights. The candidates of each tile of its image are looked up only
/// once.
class Projector {
public:
  Projector(const Surfaces& surfaces, const Camera& camera, const Sensor& sensor);

  Eigen::Vector3d position() const { return view_.pose.translation(); }  ///< m, world frame

  /// True if a point (m, world frame) of a surface with this normal is lit: it is inside the projector's
  /// image, and nothing is more than 0.1 mm in front of it.
  bool lights(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);

private:
  const Candidates& candidates_at(const Eigen::Vector2d& pixel);

  const Surfaces& surfaces_;
  Camera view_;
  TileIndex index_;
  int columns_;                                     ///< of tiles
  std::vector<std::optional<Candidates>> of_tile_;  ///< looked up so far
};

}  // namespace tanglebin
