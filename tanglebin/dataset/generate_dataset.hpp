#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tanglebin/dataset/fill_dataset.hpp"

namespace tanglebin {

/// Makes the wanted cases in `directory` (fill_dataset.hpp), in `jobs` processes, by simulation. The bytes of
/// recipe, manifest and case files depend on recipe and wanted cases alone. A case without a valid scene is a
/// failed one. `name` is that of the shard, where several runs make parts of the dataset at the same time.
FillSummary generate_dataset(const Recipe& recipe, const std::vector<CaseId>& wanted,
                             const std::filesystem::path& directory, int jobs,
                             const RunObserver& observer = {}, const std::string& name = {});

/// The same for any request, whose made_with is this program's.
FillSummary generate_cases(FillRequest request, const RunObserver& observer);

}  // namespace tanglebin
