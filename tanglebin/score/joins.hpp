#pragma once

#include <cstdint>
#include <vector>

#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/score/centre_line.hpp"

namespace tanglebin {

/// Counts of joins: pairs of pieces that a tube connects end to end.
struct Joins {
  std::int64_t in_truth;  ///< neighbours on a true tube
  std::int64_t found;     ///< those of them that are also neighbours on a modelled tube
  std::int64_t made;      ///< neighbours on a modelled tube
};

/// Counts which pieces of true tubes the modelled tubes join, and which they should join (docs/metrics.md).
Joins count_joins(const std::vector<CentreLine>& truth, const std::vector<Tube>& modelled);

}  // namespace tanglebin
