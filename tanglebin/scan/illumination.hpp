#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "tanglebin/scan/projector.hpp"

namespace tanglebin {

// Internal to the room.

/// Computes how much of the projector's light returns to the camera.
class Illumination {
public:
  Illumination(const Surfaces& surfaces, const Camera& camera, const Sensor& sensor,
               std::uint64_t scene_seed);

  /// The signal-to-noise ratio at a point (m, world frame) of a surface; 0 if the projector does not light
  /// it.
  double snr(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, std::int32_t label);

private:
  struct Material {
    double albedo;
    double gloss;
  };
  double returned(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                  const Material& material) const;

  const Sensor& sensor_;
  Eigen::Vector3d camera_position_;
  Eigen::Vector3d projector_position_;
  std::optional<Projector> projector_;  ///< only if there are shadows
  std::unordered_map<std::int32_t, Material> materials_;
  double faintest_mirror_cosine_;  ///< below it, a highlight is less than a millionth of its maximum
};

}  // namespace tanglebin
