#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tanglebin/dataset/dataset_summary.hpp"
#include "tanglebin/dataset/run_observer.hpp"
#include "tanglebin/recipe/recipe.hpp"

namespace tanglebin {

/// Something that is wrong with a dataset.
struct DatasetFault {
  std::string where;  ///< a file, or a case ("A10/3"); relative to the dataset's directory
  std::string what;
};

struct VerifySettings {
  int jobs = 1;       ///< worker processes
  bool rest = false;  ///< also simulate every heap again for settle.proof_time: does it lie still?
};

/// What came of verifying a dataset.
struct VerifySummary {
  Recipe recipe;
  std::size_t cases = 0;             ///< in the manifest
  std::string digest;                ///< of the manifest
  std::vector<DatasetFault> faults;  ///< empty for a dataset that is whole
  std::vector<CaseId> broken;        ///< cases of the recipe that are missing or have a fault
  bool was_stopped = false;          ///< by SIGINT or SIGTERM: maybe not all cases were looked at
};

/// Looks for everything that can be wrong with a dataset: cases of the recipe that are missing, failed, there
/// twice, the same as another, or not the recipe's; lines of the manifest that cannot be read, or that have
/// other seeds, drawn numbers or paths than the recipe gives; files that are
/// missing, changed, not listed, or that a case lacks; files whose format is broken; clouds with other
/// numbers of points or labels than there are tubes; tubes that overlap or are not in the bin by more than
/// the recipe lets them; a digest that is not that of the manifest; journals of runs that were cut off.
/// Throws InputError where the directory has no recipe that can be read.
VerifySummary verify_dataset(const std::filesystem::path& directory, const VerifySettings& settings,
                             const RunObserver& observer = {});

}  // namespace tanglebin
