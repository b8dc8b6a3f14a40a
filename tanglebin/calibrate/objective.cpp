#include "tanglebin/calibrate/objective.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {

std::vector<Objective> objectives() {
  return {Objective::unmixed_recall, Objective::micro_recall, Objective::panoptic_quality,
          Objective::complete_tubes};
}

std::string name_of(Objective objective) {
  switch (objective) {
    case Objective::unmixed_recall:
      return "unmixed_recall";
    case Objective::micro_recall:
      return "micro_recall";
    case Objective::panoptic_quality:
      return "panoptic_quality";
    case Objective::complete_tubes:
      return "complete_tubes";
  }
  return {};
}

Objective objective_named(const std::string& name) {
  std::vector<std::string> names;
  for (const Objective objective : objectives()) {
    if (name_of(objective) == name) return objective;
    names.push_back(name_of(objective));
  }
  throw InputError({"", 0, "objective"}, excerpt(name), fmt::format("one of {}", fmt::join(names, ", ")));
}

double value_of(Objective objective, const CaseData& data, const ModelScore& score) {
  switch (objective) {
    case Objective::unmixed_recall:
      return score.labels.unmixed_recall.value_or(0);
    case Objective::micro_recall:
      return score.labels.micro_recall;
    case Objective::panoptic_quality:
      return score.labels.detection.panoptic_quality;
    case Objective::complete_tubes:
      return static_cast<double>(score.tubes->complete_tubes) / static_cast<double>(data.tubes.size());
  }
  return 0;
}

}  // namespace tanglebin
