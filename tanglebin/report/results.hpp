#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/dataset/manifest.hpp"
#include "tanglebin/recipe/case_id.hpp"
#include "tanglebin/recipe/recipe.hpp"

// The contents of a results directory (docs/formats.md).
namespace tanglebin {

/// The settings that the results depend on (experiment.json).
struct ExperimentRecord {
  std::string version;  ///< of Tanglebin
  std::uint64_t dataset_seed = 0;
  std::vector<std::string> methods;
  std::vector<double> ratios;  ///< of points kept by downsampling, in (0, 1]
  std::uint64_t seed = 0;
  std::size_t cases = 0;
  std::string recipe_sha256;
  std::optional<Recipe> recipe{};  ///< the dataset's
  std::string dataset{};           ///< its directory; empty if unknown
  std::string dataset_digest{};    ///< empty if unknown
  /// What `experiment` was told of methods that are not built in as they are, by name: an option and the name
  /// with its value, such as "--method" and "mine=python3 label.py {cloud} {out}".
  std::map<std::string, std::pair<std::string, std::string>> options_of_methods{};
  std::optional<double> time_limit{};          ///< of commands, s
  std::optional<double> memory_limit{};        ///< the same, bytes
  std::map<std::string, double> parameters{};  ///< that are not the default
  bool has_scene_file = false;                 ///< methods were told what a scene file says
};

/// Identifies a run: a case, a method, a downsampling ratio and a scanner.
struct RunKey {
  CaseId id;
  std::string method;
  double ratio = 1;
  std::string scanner{};  ///< its name; empty for the one [scanner] of a recipe
};

/// The score of a run (results.jsonl). docs/metrics.md defines the measures. A run that failed has the score
/// of one that found nothing.
struct RunScore {
  RunKey run;
  std::string failure{};  ///< why it failed; empty if it did not
  double micro_recall = 0;
  double mean_iou = 0;
  double f1 = 0;
  double panoptic_quality = 0;
  std::optional<double> adjusted_rand_index = 0;  ///< none for a scene of one tube
  std::optional<double> unmixed_recall{};         ///< none if the cloud does not mark mixed points
  std::optional<double> centre_line_error{};      ///< m; none if no tube was found
  std::size_t true_joins = 0;
  std::size_t joins_found = 0;            ///< of the true ones
  std::size_t joins_made = 0;             ///< true or not
  std::map<std::string, double> drawn{};  ///< for its case, by path in the recipe
};

/// How long a run took (times.jsonl).
struct RunTime {
  RunKey run;
  double seconds = 0;  ///< wall clock
};

/// Pictures of a case (pictures.jsonl).
struct CasePictures {
  RunKey run;
  std::string rank;  ///< "best", "median" or "worst" of its method's runs
  double micro_recall = 0;
  std::string truth_file;   ///< PNG file, as named in the results
  std::string truth_png;    ///< its bytes; empty if it is missing
  std::string labels_file;  ///< PNG file with the method's labels
  std::string labels_png;
};

/// The contents of a results directory.
struct Results {
  std::string directory;  ///< where they are
  ExperimentRecord experiment;
  bool is_papers = false;  ///< the recipe is the paper's, so that its numbers can be compared
  std::vector<RunScore> scores;
  std::vector<RunKey> unscored;  ///< runs of cases without a visible tube
  std::vector<RunTime> times;
  std::vector<TimesRecord> generation;  ///< the dataset's times; empty if unknown
  std::vector<CasePictures> pictures;
  std::vector<std::string> scenes;  ///< in 3D, as JSON for scene_figure() (scenes.jsonl)
  bool unfinished = false;          ///< a run was interrupted or is in progress
};

/// Reads the output of `tanglebin experiment`. Only experiment.json is required; data of other missing files
/// is empty. Throws InputError with file, line and field for anything that `experiment` does not write.
Results read_results_directory(const std::filesystem::path& directory);

}  // namespace tanglebin
