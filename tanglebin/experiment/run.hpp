#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/dataset/seen_case.hpp"
#include "tanglebin/experiment/entry.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/scene/scene.hpp"
#include "tanglebin/score/score.hpp"
#include "tanglebin/score/score_tubes.hpp"

namespace tanglebin {

/// What to run on every case: each method with each ratio.
struct ExperimentSettings {
  std::vector<Entry> methods =
      built_in_entries();      ///< in the order of the results, as expect_names() expects
  std::vector<double> ratios;  ///< ascending, each in (0, 1]
  ModelSettings model{};       ///< its seed is combined with each case's name; method and ratio are ignored
  std::string profile{};       ///< the file that `model` is from, for the record
  Scene scene{};               ///< what to tell the methods instead of what the recipe says
  bool keep_models = false;    ///< also keep the labelled clouds and the tubes (kept_models.hpp)
};

/// Identifies one run.
struct RunId {
  std::string method;  ///< an entry's name
  CaseId scene;
  double ratio;
  std::string scanner{};  ///< its name; empty for the one [scanner] of a recipe

  // NOLINTNEXTLINE(modernize-use-nullptr): a false alarm of clang-tidy 14
  auto operator<=>(const RunId&) const = default;
};

/// What a run models.
inline SeenCase seen_case(const RunId& run) {
  return {run.scene, run.scanner};
}

/// Identifies what a case is modelled and scored from, its files and the numbers drawn for it: the SHA-256 of
/// its line in the manifest, without the line's end. Throws InputError if the line cannot be read.
std::string case_sha256(const Dataset& dataset, const CaseId& id);

/// The scene as known from the recipe of a case: the bin, the camera, and radius and segments of each kind of
/// tube. Of kinds with the same radius, the one with the most segments counts; among these, the longest. Of
/// lengths that differ from tube to tube, their range is known. Takes any recipe, and draws the case's random
/// numbers. Throws InputError if it has no such set, and as resolve() does.
KnownScene known_scene(const Recipe& recipe, const CaseId& id);

/// The known_scene(), but with what `told` says instead, and with what that leaves open estimated from the
/// case's cloud. The cloud is in the world frame, in metres, whatever `told` says. Throws InputError as
/// resolve() does, naming the case's cloud.
KnownScene told_scene(const Recipe& recipe, const CaseData& data, const CaseId& id, const Scene& told);

/// The seed of a case's downsampling, which depends only on (settings.model.seed, set, number of tubes,
/// case).
std::uint64_t model_seed(const ExperimentSettings& settings, const CaseId& id);

/// Models the tubes of a run's case by a method that is built in, with the known scene of its recipe. Throws
/// InputError as model_tubes() does, naming the case's cloud.
Model model_case(const KnownScene& known, const CaseData& data, const RunId& run,
                 const ExperimentSettings& settings);

/// How good a model is.
struct ModelScore {
  Score labels;                     ///< of the points in Model::filtered only (paper, Section 5)
  std::optional<TubesScore> tubes;  ///< none if only labels were given
};

/// Throws InputError naming the case's cloud if the filter left no point on a tube.
ModelScore score_model(const CaseData& data, const Model& model, bool has_tubes = true);

/// The points of Model::filtered with their true and their modelled labels.
struct ComparedClouds {
  PointCloud truth;
  PointCloud labels;  ///< with the label of the true tube that each label is assigned to; unassigned ones get
                      ///< labels after the largest true one
};
ComparedClouds compared_clouds(const CaseData& data, const Model& model);

}  // namespace tanglebin
