#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "tanglebin/score/score.hpp"

namespace tanglebin {

/// What to show predicted labels as, beside the truth: the label of the true tube that each is assigned to.
/// Those of `predicted` that are assigned to none get labels after the largest of `truth`, in their order.
/// The bin and null stay what they are.
std::map<std::int32_t, std::int32_t> shown_labels(const Score& score, const std::vector<std::int32_t>& truth,
                                                  const std::vector<std::int32_t>& predicted);

}  // namespace tanglebin
