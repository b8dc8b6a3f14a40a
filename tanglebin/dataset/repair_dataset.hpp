#pragma once

#include <filesystem>

#include "tanglebin/dataset/fill_dataset.hpp"
#include "tanglebin/dataset/verify_dataset.hpp"

namespace tanglebin {

/// Makes the broken cases that verify_dataset() found again, and no others, and updates manifest and digest.
/// Throws as generate_dataset() does.
FillSummary repair_dataset(const std::filesystem::path& directory, const VerifySummary& found, int jobs,
                           const RunObserver& observer = {});

}  // namespace tanglebin
