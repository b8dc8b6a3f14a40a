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

/// The shard's part of a list: every count-th item, from the index-th on, so that large and small tasks are
/// spread evenly.
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

/// Looks up an environment variable; nullopt where it is not set.
using Environment = std::function<std::optional<std::string>(const std::string& name)>;

/// The shard that a cluster's queue gives to this process: of a Slurm array (SLURM_ARRAY_TASK_ID, _COUNT,
/// _MIN and _STEP) or of a Kubernetes indexed job (JOB_COMPLETION_INDEX, and JOB_COMPLETIONS, which the job's
/// manifest has to set). nullopt outside of one. Throws InputError where the variables contradict each other.
std::optional<Shard> shard_from(const Environment& environment);

}  // namespace tanglebin
