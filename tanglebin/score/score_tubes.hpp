#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// How well modelled tubes match the true ones, from geometry alone. docs/metrics.md defines every measure.
struct TubesScore {
  /// m, median over the modelled centre lines' length of the distance to the nearest true one; none where
  /// nothing is modelled
  std::optional<double> centre_line_error;
  std::optional<double> centre_line_error_p95;  ///< m, the 95th percentile of the same
  double centre_line_coverage;  ///< share of the true centre lines' length within a radius of a modelled one
  std::int64_t complete_tubes;  ///< true tubes that a single modelled tube covers nearly from end to end
  std::optional<double> length_error;  ///< of these, by which share of its length such a tube is too long or
                                       ///< too short, the median; none where there is none
  std::int64_t true_joins;             ///< pairs of neighbouring pieces on a true tube
  std::int64_t joins_found;            ///< of these, pairs that a modelled tube joins
  std::int64_t joins_made;      ///< pairs that a modelled tube joins; those that are not true joins are wrong
  std::int64_t true_junctions;  ///< nodes of the true tubes at which three edges or more meet
  std::int64_t junctions_found;  ///< of these, the ones with a junction of a modelled tube within a diameter
  std::int64_t junctions_made;   ///< junctions of the modelled tubes
};

/// The score of modelled tubes. Ids and the order of tubes, nodes and edges do not matter. A modelled tube's
/// radius does not either: within a radius means that of the true tube. Throws std::invalid_argument where
/// the true tubes have no edge of any length.
TubesScore score_tubes(const std::vector<Tube>& truth, const std::vector<Tube>& modelled);

}  // namespace tanglebin
