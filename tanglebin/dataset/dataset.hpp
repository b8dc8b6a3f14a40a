#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/dataset/finished_cases.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/recipe/recipe.hpp"

namespace tanglebin {

/// A dataset on disk, as generate_dataset() left it.
struct Dataset {
  std::filesystem::path directory;
  Recipe recipe;
  std::string recipe_sha256;  ///< of recipe.toml
  FinishedCases finished;
};

/// Reads recipe, manifest and times. Throws InputError where the directory has no recipe or what it has
/// cannot be read.
Dataset read_dataset(const std::filesystem::path& directory);

/// The cases that are there, in the recipe's order.
std::vector<CaseId> cases(const Dataset& dataset);

/// The bytes of a dataset's file. Throws InputError naming the file where it is missing or not the one that
/// the manifest has the size and the checksum of.
std::string checked_bytes(const std::filesystem::path& directory, const FileRecord& file);

/// The recipe of a case that is there: the dataset's, with the numbers that were drawn for the case as the
/// manifest has them.
Recipe recipe_of(const Dataset& dataset, const CaseId& id);

/// A case read back.
struct CaseData {
  std::string cloud_file;  ///< for messages
  PointCloud cloud;        ///< of the recipe's first scanner, with the true labels
  std::vector<Tube> tubes;
};

/// Reads the cloud and the configuration of a case that is there. Throws InputError naming the file that is
/// missing, is not the one that the manifest has the checksum of, or cannot be read.
CaseData read_case(const Dataset& dataset, const CaseId& id);

}  // namespace tanglebin
