#pragma once

#include <filesystem>
#include <vector>

#include "tanglebin/dataset/fill_dataset.hpp"

namespace tanglebin {

/// Merges datasets of one recipe into `directory`, which may already have some of the cases, in `jobs`
/// processes. The result is as if one run had made them all. Files are copied and checked against their
/// manifest. Cases in none of the parts stay missing. Throws InputError if a part has another recipe or a
/// case that is not in its recipe, if two parts have different bytes for the same case, if a file is missing
/// or has changed, and as fill_dataset() does.
FillSummary merge_datasets(const std::vector<std::filesystem::path>& parts,
                           const std::filesystem::path& directory, int jobs,
                           const RunObserver& observer = {});

}  // namespace tanglebin
