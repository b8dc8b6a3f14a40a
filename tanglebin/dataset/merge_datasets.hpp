#pragma once

#include <filesystem>
#include <vector>

#include "tanglebin/dataset/fill_dataset.hpp"

namespace tanglebin {

/// Brings the cases of datasets of one recipe that were made apart together in `directory`, which may have
/// some already, in `jobs` processes: the directory is then as if one run had made them. Files are copied,
/// and each must be what its manifest says. Cases that are in no part are not wanted. Throws InputError where
/// a part has another recipe or a case that its recipe has not, where two parts have the same case in
/// different bytes, where a file is missing or has changed, and as fill_dataset() does.
FillSummary merge_datasets(const std::vector<std::filesystem::path>& parts,
                           const std::filesystem::path& directory, int jobs,
                           const RunObserver& observer = {});

}  // namespace tanglebin
