#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/paper/fit.hpp"
#include "tanglebin/model/paper/paper_settings.hpp"
#include "tanglebin/model/scene/range_image.hpp"

namespace tanglebin {

/// One of the two ends of a cylinder.
struct CylinderEnd {
  std::size_t cylinder;
  std::size_t end;  ///< 0 or 1, index into Cylinder::ends
};

/// Two ends of distinct cylinders that belong together.
struct Join {
  std::array<CylinderEnd, 2> ends;
  double cost;  ///< m
};

/// The cost of a join (Section 4): |p1 − p2| + w α with α = angle(a1, v) + angle(a2, v), v the direction
/// p1 → p2, a1 the first cylinder's axis outward at p1, a2 the second's inward at p2; w, m for each radian,
/// is the ratio of the two thresholds.
struct JoinMeasures {
  double distance;  ///< m
  double angle;     ///< rad, α
};
JoinMeasures measure_join(const Cylinder& first, std::size_t first_end, const Cylinder& second,
                          std::size_t second_end);

/// Joins cylinders into tubes, greedily by increasing cost. A pair of ends is taken when both are free and in
/// different tubes, distance and angle are under their thresholds, the tube does not become longer than
/// `length` (m), and the way between them is not seen to be empty: something hides its middle from the
/// sensor.
std::vector<Join> join_cylinders(const std::vector<Cylinder>& cylinders, const RangeImage& seen,
                                 double length, const JoinSettings& settings);

/// A tube, and the cylinders that it was made of.
struct JoinedTube {
  Tube tube;  ///< a chain: an edge for each cylinder, and one for each joint between the ends that it joins
  std::vector<std::size_t> cylinders;  ///< in the chain's order
};

/// The tubes that the joins make of the cylinders: ids 1, 2, … by the first of its cylinders.
std::vector<JoinedTube> joined_tubes(const std::vector<Cylinder>& cylinders, const std::vector<Join>& joins,
                                     double radius);

}  // namespace tanglebin
