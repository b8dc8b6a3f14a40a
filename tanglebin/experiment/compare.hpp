#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/recipe/case_id.hpp"

namespace tanglebin {

/// A method's runs in a results directory.
struct Contestant {
  std::filesystem::path results;
  std::string method;
};

/// How a measure differs, with the mean over scenes of each side. The interval of the mean difference is the
/// bootstrap's, of 95 % (Efron and Tibshirani 1993, Section 13.3: percentiles), over scenes.
struct MeasureDifference {
  std::string measure;  ///< as in results.jsonl
  double baseline;
  double other;
  double difference;  ///< other − baseline
  double low;
  double high;
};

/// The micro-recall of a scene, mean over the scanners and ratios.
struct SceneDifference {
  CaseId scene;
  double baseline;
  double other;

  double difference() const { return other - baseline; }
};

/// Two methods on the scenes, scanners and ratios that both have. A run that failed counts as one that found
/// nothing.
struct Comparison {
  Contestant baseline;
  Contestant other;
  std::size_t scenes = 0;
  std::size_t unpaired = 0;  ///< runs that only one side has
  /// unmixed_recall only if clouds mark mixed points, adjusted_rand_index only of scenes with several tubes
  std::vector<MeasureDifference> measures{};
  std::vector<SceneDifference> better{};  ///< scenes, the one with the greatest difference first
  std::vector<SceneDifference> worse{};   ///< the same
};

/// Whom to compare: in one directory, every method with the baseline (the first if none is named); in
/// several, each method of the first directory with the same one in the others, or, if there is only one in
/// each, with that. Throws InputError if there is nothing to compare, or if the directories are of different
/// datasets.
std::vector<std::pair<Contestant, Contestant>> pairs_to_compare(
    const std::vector<std::filesystem::path>& results, const std::optional<std::string>& baseline);

/// Always the same for the same results. Throws InputError if a directory has no results of its method, if
/// they have no scene in common, if one is another scene in each, or if a line of results cannot be read.
Comparison compare(const Contestant& baseline, const Contestant& other);

}  // namespace tanglebin
