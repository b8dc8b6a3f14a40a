#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/dataset/catalogue.hpp"
#include "tanglebin/dataset/manifest.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/recipe/recipe.hpp"

namespace tanglebin {

/// A dataset on disk.
struct Dataset {
  std::filesystem::path directory;
  Recipe recipe;
  std::string recipe_sha256;  ///< of recipe.toml
  Catalogue catalogue;
};

/// The recipe in a dataset's directory.
inline constexpr const char* recipe_name = "recipe.toml";

/// The dataset's own files beside the folders of its cases.
inline constexpr std::array dataset_files{recipe_name, summary_name, manifest_name, times_name, failed_name};

/// Reads it. Throws InputError if it is missing, no regular file, or no recipe.
Recipe recipe_in(const std::filesystem::path& directory);

/// Reads the recipe and where each case is listed. Throws InputError if the directory has no recipe, or if a
/// file cannot be read. A damaged record is an error when its case is read.
Dataset read_dataset(const std::filesystem::path& directory);

/// The finished cases, in the recipe's order.
std::vector<CaseId> cases(const Dataset& dataset);

/// The bytes of a dataset's file. Throws InputError naming the file if it is missing or has another size or
/// checksum than in the manifest.
std::string checked_bytes(const std::filesystem::path& directory, const FileRecord& file);

/// The recipe of a finished case: the dataset's with the numbers that were drawn for the case, from the
/// manifest.
Recipe recipe_of(const Dataset& dataset, const CaseId& id);

/// A case read back.
struct CaseData {
  std::string cloud_file;  ///< for messages
  PointCloud cloud;        ///< of one of the recipe's scanners, with the true labels
  std::vector<Tube> tubes;
};

/// Throws InputError naming the recipe's setting if the dataset was made without clouds.
void expect_clouds(const Dataset& dataset);

/// Reads the cloud and the configuration of a finished case. Throws InputError if the dataset has no clouds,
/// and naming the file that is missing, has another checksum than in the manifest, or cannot be read.
CaseData read_case(const Dataset& dataset, const CaseId& id);

}  // namespace tanglebin
