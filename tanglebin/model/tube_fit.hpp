#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tanglebin/model/fragments.hpp"
#include "tanglebin/model/links.hpp"
#include "tanglebin/tube/tube.hpp"

namespace tanglebin {

struct TubeFitSettings {
  double tolerance = 0.08;    ///< radii, by which a centre line may miss the fragments' nodes before the fit
  double residual_max = 0.3;  ///< radii; a point farther from the surface does not count
  std::size_t points_max = 600;  ///< points that a tube is fitted to
  int iterations = 4;            ///< Gauss-Newton steps
};

/// The tube of some fragments (their indices) and of those of the chosen links that are between them:
/// straight pieces, as few as follow the fragments' centre lines, then moved by least squares so that the
/// surface of this radius (m) passes through the fragments' points. Ends and junctions are nodes 1, 2, …;
/// mass 0.
Tube fit_tube(const std::vector<Fragment>& fragments, const std::vector<std::size_t>& members,
              const std::vector<Link>& links, const std::vector<std::size_t>& chosen,
              const std::vector<Eigen::Vector3f>& points, double radius, const TubeFitSettings& settings);

}  // namespace tanglebin
