#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "tanglebin/dataset/fill_dataset.hpp"

namespace tanglebin {

/// Makes the wanted cases in `directory` (fill_dataset.hpp) by simulation, in `jobs` processes. The bytes of
/// recipe, manifest and case files depend only on the recipe and the wanted cases. A case without a valid
/// scene fails. Throws InputError if the recipe does not have a wanted case, if the directory has files but
/// is no dataset of this recipe, or if a file cannot be read.
FillSummary generate_dataset(const Recipe& recipe, const std::vector<CaseId>& wanted,
                             const std::filesystem::path& directory, int jobs,
                             const RunObserver& observer = {}, const std::optional<Shard>& shard = {});

/// The same for any request; sets its made_with to this program's versions.
FillSummary generate_cases(FillRequest request, const RunObserver& observer);

}  // namespace tanglebin
