#pragma once

#include <cstddef>

#include "tanglebin/score/confusion.hpp"

// The measures beside micro-recall; docs/metrics.md defines each. None of them depends on the assignment.
namespace tanglebin {

/// How many tubes are found. A segment detects a tube where their IoU is above 0.5, which no tube or segment
/// reaches twice (Kirillov et al. 2019, Section 4.1). All are 0 where nothing is detected.
struct Detection {
  double precision;         ///< of the segments, how many detect a tube
  double recall;            ///< of the tubes, how many are detected
  double f1;                ///< harmonic mean of both
  double panoptic_quality;  ///< f1 times the mean IoU of the detected tubes
};
Detection detection(const Confusion& confusion);

/// Agreement on which pairs of points belong together, 1 for full agreement, 0 as expected of chance (Hubert
/// and Arabie 1985, Equation 5). A point that no segment claims belongs together with no other.
double adjusted_rand_index(const Confusion& confusion);

/// What became of the tubes and segments (Hoover et al. 1996), "most" being more than half. A tube
/// or segment counts in one instance at most: the best fitting.
struct Instances {
  std::size_t correct = 0;          ///< a tube and a segment that have most of each other
  std::size_t over_segmented = 0;   ///< a tube, most of it covered by two segments or more that have most of
                                    ///< their points on it
  std::size_t under_segmented = 0;  ///< a segment, most of it on two tubes or more that it covers most of
  std::size_t missed = 0;           ///< a tube in none of these
  std::size_t noise = 0;            ///< a segment in none of these
};
Instances count_instances(const Confusion& confusion);

}  // namespace tanglebin
