#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tanglebin/dataset/fill_dataset.hpp"

namespace tanglebin {

/// Makes the wanted cases in `directory` (fill_dataset.hpp) by simulation, in `jobs` processes. The bytes of
/// recipe, manifest and case files depend only on the recipe and the wanted cases. A case without a valid
/// scene fails. `name` is the shard's, if several runs make parts of the dataset at the same time.
FillSummary generate_dataset(const Recipe& recipe, const std::vector<CaseId>& wanted,
                             const std::filesystem::path& directory, int jobs,
                             const RunObserver& observer = {}, const std::string& name = {});

/// The same for any request; sets its made_with to this program's versions.
FillSummary generate_cases(FillRequest request, const RunObserver& observer);

}  // namespace tanglebin
