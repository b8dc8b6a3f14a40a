#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/scene/filter.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/shared_settings.hpp"

namespace tanglebin {

/// What is known of the surfaces that are not a tube's.
struct OtherSurfaces {
  Support support{.shape = Support::Shape::nothing};
  /// Unit, towards the sensor, of the surface at each point of the cloud; NaN where it is not known. Empty if
  /// none is known.
  std::vector<Eigen::Vector3f> normals{};
};

/// For each point (an index into the cloud): the id of the tube with the nearest cylinder or joint, or
/// null_label if none is near enough, or the support is nearer. A surface that faces a tube is not the
/// tube's: such as a table beside it, or a wall.
std::vector<std::int32_t> label_by_nearest(const PointCloud& cloud, const std::vector<std::size_t>& points,
                                           const std::vector<Tube>& tubes, const LabelSettings& settings,
                                           const OtherSurfaces& others = {});

/// A label for each point of the cloud: bin_label on the support, null_label outside of the crop and without
/// a position. Any other point gets its label in `claimed`, which has null elsewhere, or if that is null, the
/// label of the nearest surface. If there is none, a point within the support's margin gets bin_label too.
std::vector<std::int32_t> label_points(const PointCloud& cloud, const Cropped& cropped,
                                       std::vector<std::int32_t> claimed, const std::vector<Tube>& tubes,
                                       const LabelSettings& settings, const OtherSurfaces& others = {});

}  // namespace tanglebin
