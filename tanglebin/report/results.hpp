#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/dataset/manifest.hpp"
#include "tanglebin/recipe/case_id.hpp"

// What a results directory holds (docs/formats.md).
namespace tanglebin {

/// What the results follow from (experiment.json).
struct ExperimentRecord {
  std::string version;  ///< of Tanglebin
  std::uint64_t dataset_seed = 0;
  std::vector<std::string> methods;
  std::vector<double> ratios;  ///< of points kept by downsampling, in (0, 1]
  std::uint64_t seed = 0;
  std::size_t cases = 0;
  std::string recipe_sha256;
};

/// A method run on a case with a downsampling ratio.
struct RunKey {
  CaseId id;
  std::string method;
  double ratio = 1;
};

/// What a run was worth (results.jsonl); docs/metrics.md defines the measures.
struct RunScore {
  RunKey run;
  double micro_recall = 0;
  double mean_iou = 0;
  double f1 = 0;
  double panoptic_quality = 0;
  double adjusted_rand_index = 0;
  std::optional<double> centre_line_error;  ///< m; none where no tube was found
  std::size_t true_joins = 0;
  std::size_t joins_found = 0;  ///< of the true ones
  std::size_t joins_made = 0;   ///< true or not
};

/// How long a run took (times.jsonl).
struct RunTime {
  RunKey run;
  double seconds = 0;  ///< wall clock
};

/// A case to look at (pictures.jsonl).
struct CasePictures {
  RunKey run;
  std::string rank;  ///< "best", "median" or "worst" of its method's runs
  double micro_recall = 0;
  std::string truth_file;   ///< PNG, as the results name it
  std::string truth_png;    ///< its bytes; empty where it is missing
  std::string labels_file;  ///< PNG of the method's labels
  std::string labels_png;
};

/// A results directory.
struct Results {
  ExperimentRecord experiment;
  std::vector<RunScore> scores;
  std::vector<RunTime> times;
  std::vector<TimesRecord> generation;  ///< the dataset's times; empty where they are not known
  std::vector<CasePictures> pictures;
  bool unfinished = false;  ///< a run was cut off, or is under way
};

/// Reads what `tanglebin experiment` wrote. Only experiment.json must be there: of the other files, what is
/// missing is empty. Throws InputError with file, line and field for what `experiment` does not write.
Results read_results_directory(const std::filesystem::path& directory);

}  // namespace tanglebin
