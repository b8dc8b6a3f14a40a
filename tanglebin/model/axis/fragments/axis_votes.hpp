#pragma once

#include <Eigen/Core>
#include <vector>

#include "tanglebin/model/axis/fragments/surface_patches.hpp"
#include "tanglebin/model/axis/settings/axis_settings.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// For each point of a cloud, its vote for a point on its tube's axis; NaN if it has none.
struct AxisVotes {
  std::vector<Eigen::Vector3f> votes;    ///< m, a point on the axis
  std::vector<Eigen::Vector3f> normals;  ///< unit, of the surface, towards the sensor
  float reach = 0;                       ///< m, from a point to those from which its normal comes
};

/// Each point votes for the point one radius (m) inwards along its surface normal, which lies on its tube's
/// axis. The normal is that of a plane through its neighbours in the camera's image. There is no vote where
/// two surfaces meet, nor for an axis in the support or too near to it, nor from a flat surface unless the
/// support holds_only_tubes(); its points have a normal all the same. Where points are dense, a few beside
/// each other share a patch and its vote. Points in the support's frame.
AxisVotes vote_for_axes(std::vector<Eigen::Vector3f> points, const Support& support, const Camera& camera,
                        double radius, const VoteSettings& settings);

}  // namespace tanglebin
