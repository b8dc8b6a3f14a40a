#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tanglebin {

/// Part number `index` of `count`, both from 1.
struct Shard {
  int index = 1;
  int count = 1;
};

/// The shard's part of a list: every count-th item, starting with the index-th. This spreads large and small
/// tasks evenly.
template <typename Item>
std::vector<Item> part_of(const Shard& shard, const std::vector<Item>& all) {
  std::vector<Item> part;
  const auto count = static_cast<std::size_t>(shard.count);
  part.reserve(all.size() / count + 1);
  for (auto i = static_cast<std::size_t>(shard.index - 1); i < all.size(); i += count) part.push_back(all[i]);
  return part;
}

/// "2-of-8", as a part of file names.
std::string name_of(const Shard& shard);

/// Looks up an environment variable; nullopt if it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

/// The variable that says that this process is one of many: SLURM_ARRAY_TASK_ID in a Slurm array,
/// JOB_COMPLETION_INDEX in a Kubernetes indexed job; nullopt outside of these.
std::optional<std::string> array_variable(const Environment& environment);

/// The shard that a cluster's queue assigns to this process: in a Slurm array (SLURM_ARRAY_TASK_ID, _COUNT,
/// _MIN and _STEP) or a Kubernetes indexed job (JOB_COMPLETION_INDEX, and JOB_COMPLETIONS, which the job's
/// manifest must set). nullopt outside of these. Throws InputError if the variables contradict each other.
std::optional<Shard> shard_from(const Environment& environment);

}  // namespace tanglebin
