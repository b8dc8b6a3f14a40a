#pragma once

#include <filesystem>
#include <vector>

#include "tanglebin/dataset/manifest.hpp"
#include "tanglebin/dataset/recipe.hpp"
#include "tanglebin/dataset/verify_dataset.hpp"

// Internal to the library: one case of verify_dataset().
namespace tanglebin {

/// What is wrong with the files and the physics of a case. With `rest`, its heap is simulated, too.
std::vector<DatasetFault> faults_of_case(const std::filesystem::path& directory, const Recipe& recipe,
                                         const CaseRecord& record, bool rest);

}  // namespace tanglebin
