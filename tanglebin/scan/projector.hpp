#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/scan/sensor.hpp"
#include "tanglebin/scan/tile_index.hpp"

namespace tanglebin {

// Internal to the room.

/// Where the projector is and what its image covers, as a camera that sees what it lights.
Camera projector_beside(const Camera& camera, const Sensor& sensor);

/// Says which points the projector lights. Looks up what its rays may meet once for each tile of its image.
class Projector {
public:
  Projector(const Surfaces& surfaces, const Camera& camera, const Sensor& sensor);

  Eigen::Vector3d position() const { return view_.pose.translation(); }  ///< m, world frame

  /// Is the point (m, world frame) of a surface with this normal lit? Neither outside of the projector's
  /// image nor behind anything that is more than 0.1 mm in front of the point.
  bool lights(const Eigen::Vector3d& point, const Eigen::Vector3d& normal);

private:
  const Candidates& candidates_at(const Eigen::Vector2d& pixel);

  const Surfaces& surfaces_;
  Camera view_;
  TileIndex index_;
  int columns_;                                     ///< of tiles
  std::vector<std::optional<Candidates>> of_tile_;  ///< those looked up so far
};

}  // namespace tanglebin
