#include "tanglebin/dataset/repair_dataset.hpp"

#include "tanglebin/dataset/generate_dataset.hpp"

namespace tanglebin {

FillSummary repair_dataset(const std::filesystem::path& directory, const VerifySummary& found, int jobs,
                           const RunObserver& observer) {
  return generate_cases({.recipe = found.recipe,
                         .wanted = found.broken,
                         .directory = directory,
                         .jobs = jobs,
                         .repair = found.broken},
                        observer);
}

}  // namespace tanglebin
