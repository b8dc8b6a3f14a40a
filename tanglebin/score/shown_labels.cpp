#include "tanglebin/score/shown_labels.hpp"

#include <algorithm>

#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {

std::map<std::int32_t, std::int32_t> shown_labels(const Score& score, const std::vector<std::int32_t>& truth,
                                                  const std::vector<std::int32_t>& predicted) {
  std::map<std::int32_t, std::int32_t> shown_as{{bin_label, bin_label}, {null_label, null_label}};
  for (const TubeScore& tube : score.tubes) {
    if (tube.assigned) shown_as[*tube.assigned] = tube.label;
  }
  std::int32_t largest = bin_label;
  for (const std::int32_t label : truth) largest = std::max(largest, label);
  for (const std::int32_t label : predicted) {
    if (!shown_as.contains(label)) shown_as[label] = ++largest;
  }
  return shown_as;
}

}  // namespace tanglebin
