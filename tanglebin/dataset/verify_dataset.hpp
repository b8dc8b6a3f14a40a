#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/dataset/dataset_summary.hpp"
#include "tanglebin/dataset/run_observer.hpp"
#include "tanglebin/recipe/recipe.hpp"

namespace tanglebin {

/// A fault of a dataset.
struct DatasetFault {
  std::string where;  ///< a file, or a case ("A10/3"); relative to the dataset's directory
  std::string what;
};

struct VerifySettings {
  int jobs = 1;                                 ///< worker processes
  bool rest = false;                            ///< also test by simulation that every heap is at rest
  std::optional<std::vector<CaseId>> wanted{};  ///< the cases to check; all if not set
};

/// The result of a verification.
struct VerifySummary {
  Recipe recipe;
  std::size_t cases = 0;             ///< finished
  std::string digest;                ///< of the finished cases
  std::vector<DatasetFault> faults;  ///< empty for an intact dataset
  std::vector<DatasetFault> notes;   ///< what is no fault: runs in progress, files that are not the dataset's
  std::vector<CaseId> broken;        ///< wanted cases that are missing or faulty
  bool is_in_progress = false;       ///< runs are at work in it
  bool was_stopped = false;          ///< by SIGINT or SIGTERM, perhaps before all cases were checked
};

/// Looks for everything that can be wrong with a dataset: cases of the recipe that are missing, failed,
/// listed twice or equal to another, and cases not in the recipe; damaged lines of the manifest, or lines
/// with other seeds, drawn numbers or paths than the recipe gives; files that are missing, changed or not
/// listed; broken formats; clouds whose number of points or labels does not match; tubes that overlap or
/// stick out of the bin more than the recipe allows; a digest that does not match the manifest; journals of
/// runs that have ended. Only wanted cases are checked and missed. While runs are in progress, it checks what
/// was finished when it began, and misses nothing. Throws InputError if the directory has no readable recipe,
/// or does not have a wanted case.
VerifySummary verify_dataset(const std::filesystem::path& directory, const VerifySettings& settings,
                             const RunObserver& observer = {});

}  // namespace tanglebin
