#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/paper/fit.hpp"
#include "tanglebin/model/paper/paper_settings.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
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

/// The terms of the cost of a join (Section 4), |p1 − p2| + w α. Here α = angle(a1, v) + angle(a2, v), v is
/// the direction p1 → p2, a1 the first cylinder's axis outward at p1, and a2 the second's inward at p2. The
/// weight w (m per radian) is the ratio of the two thresholds.
struct JoinMeasures {
  double distance;  ///< m
  double angle;     ///< rad, α
};
JoinMeasures measure_join(const Cylinder& first, std::size_t first_end, const Cylinder& second,
                          std::size_t second_end);

/// Joins cylinders into tubes, greedily by increasing cost. A pair of ends is accepted if both are free and
/// in different tubes, their distance and angle are below the thresholds, the tube gets no longer than
/// `length` (m), and the gap was not seen to be empty: something occludes its middle.
std::vector<Join> join_cylinders(const std::vector<Cylinder>& cylinders, const RangeImage& seen,
                                 double length, const JoinSettings& settings);

/// A tube and its cylinders.
struct JoinedTube {
  Tube tube;  ///< a chain: an edge for each cylinder, and one for each joint between two joined ends
  std::vector<std::size_t> cylinders;  ///< in the order of the chain
};

/// The tubes of a kind that result from the joins. Ids 1, 2, … follow each tube's first cylinder. A flat end
/// is where the cylinder's points end, a round one where it was trimmed.
std::vector<JoinedTube> joined_tubes(const std::vector<Cylinder>& cylinders, const std::vector<Join>& joins,
                                     const TubeKind& kind);

}  // namespace tanglebin
