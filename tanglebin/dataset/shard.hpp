#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/dataset/case_id.hpp"

namespace tanglebin {

/// Part number `index` of `count`, both from 1.
struct Shard {
  int index = 1;
  int count = 1;
};

/// The shard's cases: every count-th, from the index-th on, so that large and small scenes are spread evenly.
std::vector<CaseId> cases_of(const Shard& shard, const std::vector<CaseId>& cases);

/// "2-of-8", as a part of file names.
std::string name_of(const Shard& shard);

/// Looks up an environment variable; nullopt where it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

/// The shard that a cluster's queue gives to this process: of a Slurm array (SLURM_ARRAY_TASK_ID, _COUNT,
/// _MIN and _STEP) or of a Kubernetes indexed job (JOB_COMPLETION_INDEX, and JOB_COMPLETIONS, which the job's
/// manifest has to set). nullopt outside of one. Throws InputError where the variables contradict each other.
std::optional<Shard> shard_from(const Environment& environment);

}  // namespace tanglebin
