#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/links/links.hpp"
#include "tanglebin/model/axis/settings/axis_settings.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// Fits a tube to the fragments `members` and the chosen links between them. As few straight pieces as
/// possible follow the centre line; least squares then moves them so that the surface of a tube of this kind
/// passes through the fragments' points. A flat end's node is the middle of its face. Ends and junctions are
/// nodes 1, 2, …; the mass is 0.
Tube fit_tube(const std::vector<Fragment>& fragments, const std::vector<std::size_t>& members,
              const std::vector<Link>& links, const std::vector<std::size_t>& chosen,
              const std::vector<Eigen::Vector3f>& points, const TubeKind& kind,
              const TubeFitSettings& settings);

}  // namespace tanglebin
