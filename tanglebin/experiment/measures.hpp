#pragma once

#include "tanglebin/files/json_record.hpp"
#include "tanglebin/score/score.hpp"
#include "tanglebin/score/score_tubes.hpp"

// The measures by the names that docs/metrics.md gives them.
namespace tanglebin {

/// Everything but the single tubes and the confusion matrix.
Json measures_json(const Score& score);

/// Lengths in m.
Json measures_json(const TubesScore& score);

Json tube_json(const TubeScore& tube);

}  // namespace tanglebin
