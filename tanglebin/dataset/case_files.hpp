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

/// The paths of a case's files: those of case_files(), in its order.
std::vector<std::string> paths_of(const Recipe& recipe, const CaseId& id);

/// The files of a case, those that recipe.output asks for (docs/formats.md), of each of the recipe's
/// scanners; the recipe is the scene's, without random numbers.
std::vector<CaseFile> case_files(const Recipe& recipe, const CaseId& id, const Scene& scene);

}  // namespace tanglebin
