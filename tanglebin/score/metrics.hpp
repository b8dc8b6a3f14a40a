#pragma once

#include <cstddef>

#include "tanglebin/score/confusion.hpp"

// The measures besides micro-recall, as defined in docs/metrics.md. None depends on the assignment.
namespace tanglebin {

/// How many tubes are found. A segment detects a tube if their IoU is above 0.5, which is possible only once
/// for each tube and segment (Kirillov et al. 2019, Section 4.1). All values are 0 if nothing is detected.
struct Detection {
  double precision;         ///< fraction of the segments that detect a tube
  double recall;            ///< fraction of the tubes that are detected
  double f1;                ///< harmonic mean of both
  double panoptic_quality;  ///< f1 times the mean IoU of the detected tubes
};
Detection detection(const Confusion& confusion);

/// Agreement on which pairs of points belong together: 1 for full agreement, 0 as expected by chance (Hubert
/// and Arabie 1985, Equation 5). A point in no segment is a cluster by itself.
double adjusted_rand_index(const Confusion& confusion);

/// Classification of the tubes and segments (Hoover et al. 1996), where "most" means more than half. A tube
/// or segment counts in at most one instance, the best fitting one.
struct Instances {
  std::size_t correct = 0;          ///< a tube and a segment that share most of each other
  std::size_t over_segmented = 0;   ///< a tube covered mostly by two or more segments, each mostly on it
  std::size_t under_segmented = 0;  ///< a segment mostly on several tubes, of each of which it covers most
  std::size_t missed = 0;           ///< a tube in none of these
  std::size_t noise = 0;            ///< a segment in none of these
};
Instances count_instances(const Confusion& confusion);

}  // namespace tanglebin
