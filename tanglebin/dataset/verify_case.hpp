#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/dataset/manifest.hpp"
#include "tanglebin/dataset/verify_dataset.hpp"
#include "tanglebin/recipe/recipe.hpp"

// Internal to the library: one case of verify_dataset().
namespace tanglebin {

/// An error's text without its file.
std::string complaint_of(const InputError& error);

/// What is wrong with these bytes as an SDF world, or as a PNG picture of this size (which is decoded): one
/// line, empty if nothing is.
std::string fault_of_world(const std::string& bytes);
std::string fault_of_png(const std::string& bytes, int width, int height);

/// What is wrong with the record, the files and the physics of a case. With `rest`, also simulates its heap.
std::vector<DatasetFault> faults_of_case(const std::filesystem::path& directory, const Recipe& recipe,
                                         const CaseRecord& record, bool rest);

}  // namespace tanglebin
