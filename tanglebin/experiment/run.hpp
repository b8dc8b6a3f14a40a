#pragma once

#include <compare>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/score/score.hpp"
#include "tanglebin/score/score_tubes.hpp"

namespace tanglebin {

/// What is tried on every case: each method with each ratio.
struct ExperimentSettings {
  std::vector<Method> methods = tanglebin::methods();  ///< as methods() orders them, without repetition
  std::vector<double> ratios;                          ///< ascending, each in (0, 1]
  ModelSettings model{};  ///< its seed is mixed with each case's name; method and ratio are ignored
};

/// One of these trials.
struct RunId {
  Method method;
  CaseId scene;
  double ratio;

  // NOLINTNEXTLINE(modernize-use-nullptr): a false alarm of clang-tidy 14
  auto operator<=>(const RunId&) const = default;
};

/// What the recipe of a case tells of its scene: the bin, the camera, and of each kind of tubes the radius
/// and the segments; kinds of one radius are taken for the one of the most segments, of these the longest.
KnownScene known_scene(const Recipe& recipe, const CaseId& id);

/// Models the tubes of a run's case, whose bin, camera, radius and length the recipe tells. The model's seed
/// follows from (settings.model.seed, set, number of tubes, case) alone. Throws InputError as model_tubes()
/// does, naming the case's cloud.
Model model_case(const Dataset& dataset, const CaseData& data, const RunId& run,
                 const ExperimentSettings& settings);

/// How good a model is.
struct ModelScore {
  Score labels;  ///< of the points of Model::filtered alone (paper, Section 5)
  TubesScore tubes;
};

/// Throws InputError naming the case's cloud where the filter left no point of a tube.
ModelScore score_model(const CaseData& data, const Model& model);

/// The points of Model::filtered as the truth has them and as the model has them.
struct ComparedClouds {
  PointCloud truth;
  PointCloud labels;  ///< a tube's label is that of the true tube it is assigned to; those assigned to none
                      ///< have the labels after the largest true one
};
ComparedClouds compared_clouds(const CaseData& data, const Model& model);

}  // namespace tanglebin
