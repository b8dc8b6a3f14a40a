#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/axis/fragments/fragments.hpp"

// Internal to the room.
namespace tanglebin {

/// The radius that points on a tube show, whatever the tube's own is.
struct SeenRadius {
  double radius = 0;       ///< m, the median over short pieces of the tube
  double error = 0;        ///< m, standard error, from how much the pieces differ
  std::size_t pieces = 0;  ///< that show one
};

/// Fits a circle to the section of each piece of the tube that is two radii long, by least squares along the
/// rays, where the noise is. Only the tube's direction counts, and that it runs about in the middle of what
/// is seen. `members` are the fragments that it was fitted to, `points` (m) what their points are indices of.
/// Returns what all members show together, and if there are several, what each of them does; without those
/// that show no arc.
std::vector<SeenRadius> seen_radii(const Tube& tube, const std::vector<Fragment>& fragments,
                                   const std::vector<std::size_t>& members,
                                   const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3d& sensor);

}  // namespace tanglebin
