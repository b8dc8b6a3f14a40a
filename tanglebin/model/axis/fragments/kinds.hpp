#pragma once

#include <Eigen/Core>
#include <vector>

#include "tanglebin/model/axis/fragments/axis_votes.hpp"
#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// Splits points (m, without the bin's) by the kind of tube they are on. Each result has as many entries as
/// `points`, with NaN for points on another kind. The surface's curvature tells the kinds apart; points on a
/// piece that shows too little curvature belong to no kind. With a single kind, all points belong to it.
std::vector<std::vector<Eigen::Vector3f>> points_by_kind(std::vector<Eigen::Vector3f> points,
                                                         const KnownScene& known, const VoteSettings& vote,
                                                         const FragmentSettings& fragment);

}  // namespace tanglebin
