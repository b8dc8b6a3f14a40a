#pragma once

#include <vector>

#include "../scan/scene.hpp"
#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/model.hpp"
#include "tanglebin/scan/scanner.hpp"

namespace tanglebin::test {

/// The paper's bin and scanner.
inline KnownScene paper_scene() {
  return {.bin = bin_preset("paper"), .camera = camera_preset("paper")};
}

/// What the paper's scanner sees of tubes in the paper's bin, the bin included.
inline PointCloud scanned(const std::vector<Tube>& tubes) {
  const KnownScene scene = paper_scene();
  return cloud_from_scan(scan(tubes, scene.bin, scene.camera), CloudOf::tubes_and_bin,
                         static_cast<int>(tubes.size()));
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
  return chain(id, 0.0125, {{-0.25, y, 0.0125}, {0.25, y, 0.0125}});
}

}  // namespace tanglebin::test
