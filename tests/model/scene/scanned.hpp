#pragma once

#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/scan/scan_output.hpp"
#include "tanglebin/scan/scanner.hpp"
#include "tests/scan/scene.hpp"

namespace tanglebin::test {

/// The paper's bin and scanner.
inline KnownScene paper_scene() {
  return {.support = {.bin = bin_preset("paper")}, .camera = camera_preset("paper")};
}

inline constexpr double radius = 0.0125;  ///< m, of the paper's tubes

/// What the paper's scanner sees of tubes in the paper's bin, the bin included.
inline PointCloud scanned(const std::vector<Tube>& tubes) {
  const KnownScene scene = paper_scene();
  return cloud_from_scan(scan(tubes, scene.support.bin, scene.camera), CloudOf::tubes_and_bin,
                         static_cast<int>(tubes.size()));
}

/// A camera 2 m above the origin whose pixels are 2 mm wide on the floor.
inline Camera small_camera() {
  return downward_camera(101, 101, 1000, {0, 0, 2});
}

/// A cloud of points without labels.
inline PointCloud cloud_of(const std::vector<Eigen::Vector3f>& points) {
  PointCloud cloud;
  cloud.points = points;
  cloud.width = points.size();
  return cloud;
}

/// A tube that lies on the floor along x, half a metre long, at this y.
inline Tube straight_tube(int id, double y) {
  return chain(id, radius, {{-0.25, y, radius}, {0.25, y, radius}});
}

}  // namespace tanglebin::test
