#pragma once

#include <filesystem>

#include "tanglebin/dataset/fill_dataset.hpp"
#include "tanglebin/dataset/verify_dataset.hpp"

namespace tanglebin {

/// Makes the broken cases that verify_dataset() found again, and no others, and updates manifest and digest.
/// Throws InputError, and changes nothing, if a directory is where a file belongs or the other way round;
/// else throws as generate_dataset() does.
FillSummary repair_dataset(const std::filesystem::path& directory, const VerifySummary& found, int jobs,
                           const RunObserver& observer = {});

}  // namespace tanglebin
