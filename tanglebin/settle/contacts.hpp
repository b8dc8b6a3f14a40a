#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// Two surfaces that are no farther apart than this touch, m. Tubes at rest overlap by about the settling's
/// surface layer.
inline constexpr double touching_gap = 0.0001;

/// A place where a tube touches another one or the bin.
struct Contact {
  int tube;                             ///< its id
  int other;                            ///< the other tube's, which is larger; bin_label for the bin
  std::optional<std::size_t> bin_part;  ///< which of the bin's boxes()
  Eigen::Vector3d point;                ///< m, world frame, midway between the surfaces
  double gap;                           ///< m, between the surfaces; if they overlap, minus the depth
};

/// All contacts of tubes with each other and with the bin, in order of tube, other and part. Of places less
/// than a radius apart (the smaller one's), only that of the smallest gap counts. Tubes that lie along each
/// other touch once for each pair of their cylinders, and a tube that lies along the bin at each of its
/// nodes.
std::vector<Contact> contacts(const std::vector<Tube>& tubes, const Bin& bin);

}  // namespace tanglebin
