#pragma once

#include <string>
#include <vector>

#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/recipe/recipe.hpp"
#include "tanglebin/simulate/simulate.hpp"

namespace tanglebin {

/// A file of a dataset.
struct CaseFile {
  std::string path;   ///< relative to the dataset's directory: "A10/plys/1.ply"
  std::string bytes;  ///< all of it
};

/// The paths of a case's files, in the order of case_files().
std::vector<std::string> paths_of(const Recipe& recipe, const CaseId& id);

/// The files of a case that recipe.output asks for (docs/formats.md), for each scanner. The recipe must be
/// resolved: without random numbers.
std::vector<CaseFile> case_files(const Recipe& recipe, const CaseId& id, const SimulatedScene& scene);

}  // namespace tanglebin
