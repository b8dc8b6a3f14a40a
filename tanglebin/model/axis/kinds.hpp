#pragma once

#include <Eigen/Core>
#include <vector>

#include "tanglebin/model/axis/axis_votes.hpp"
#include "tanglebin/model/axis/fragments.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// The points (m; without the bin's) on the tubes of each known kind: for each kind as many as there are, NaN
/// where a point is on a tube of another kind. Of which kind a piece of surface is its curvature tells; where
/// it shows too little of it, its points are of none. Of a single kind are all.
std::vector<std::vector<Eigen::Vector3f>> points_by_kind(const std::vector<Eigen::Vector3f>& points,
                                                         const KnownScene& known, const VoteSettings& vote,
                                                         const FragmentSettings& fragment);

}  // namespace tanglebin
