#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/files/json_record.hpp"

// Internal to the library: why a run has no score, in lines of results.jsonl.
namespace tanglebin {

/// Where a run failed.
enum class FailureOf {
  scene,   ///< no point of the cloud is on a tube: there is nothing to score
  method,  ///< the method could not model the case, or left no point on a tube
  worker  ///< the case ended its worker process twice, or failed otherwise twice; the next run tries it again
};

struct RunFailure {
  FailureOf of;
  std::string reason;
};

/// Why no method can be scored on a cloud with these true labels; none if a point is on a tube.
std::optional<RunFailure> failure_of_scene(const std::vector<std::int32_t>& labels);

/// Adds the failure to a line.
void add_failure(Json& json, const RunFailure& failure);

/// The failure in a line; none if the run has a score. Throws InputError.
std::optional<RunFailure> failure_in(const JsonRecord& record);

}  // namespace tanglebin
