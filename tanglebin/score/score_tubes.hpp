#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// How well modelled tubes match the true ones, from geometry only. docs/metrics.md defines every measure.
struct TubesScore {
  /// m, median distance of the modelled centre lines from the nearest true one, over their length. None if
  /// nothing is modelled.
  std::optional<double> centre_line_error;
  std::optional<double> centre_line_error_p95;  ///< m, the 95th percentile of the same
  double centre_line_coverage;  ///< fraction of the true length within a radius of a modelled centre line
  std::int64_t complete_tubes;  ///< true tubes that a single modelled tube covers almost from end to end
  std::optional<double> length_error;  ///< median relative length error of these; none if there are none
  std::int64_t true_joins;             ///< pairs of neighbouring pieces on a true tube
  std::int64_t joins_found;            ///< those of them that a modelled tube joins
  std::int64_t joins_made;      ///< pairs that a modelled tube joins; those that are not true joins are wrong
  std::int64_t true_junctions;  ///< nodes of the true tubes where three or more edges meet
  std::int64_t junctions_found;  ///< those of them with a modelled junction within a diameter
  std::int64_t junctions_made;   ///< junctions of the modelled tubes
};

/// Scores modelled tubes. Ids and the order of tubes, nodes and edges do not matter, and neither does a
/// modelled tube's radius: "within a radius" refers to the true tube. Throws InputError unless the true
/// tubes are valid as validate(Tube) has it, and the modelled ones' nodes finite and edges between them;
/// std::invalid_argument if no true tube has an edge with a length.
TubesScore score_tubes(const std::vector<Tube>& truth, const std::vector<Tube>& modelled);

}  // namespace tanglebin
