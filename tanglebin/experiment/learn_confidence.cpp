#include "tanglebin/experiment/learn_confidence.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <map>

#include "tanglebin/base/error.hpp"
#include "tanglebin/experiment/run.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/score/score_clouds.hpp"

namespace tanglebin {
namespace {

using ConfidenceVector = Eigen::Matrix<double, confidence_features, 1>;
using ConfidenceMatrix = Eigen::Matrix<double, confidence_features, confidence_features>;

/// The points of a modelled tube by their true label.
using PointsOn = std::map<std::int32_t, std::size_t>;

bool is_whole(const PointsOn& points, const PointsOn& all) {
  constexpr double nearly_all = 0.95;
  std::size_t total = 0;
  for (const auto& [label, count] : points) total += count;
  return std::ranges::any_of(points, [&](const auto& entry) {
    const auto& [label, count] = entry;
    return label > bin_label && static_cast<double>(count) >= nearly_all * static_cast<double>(total) &&
           static_cast<double>(count) >= nearly_all * static_cast<double>(all.at(label));
  });
}

Eigen::Map<const ConfidenceVector> vector_of(const ConfidenceFeatures& features) {
  return Eigen::Map<const ConfidenceVector>(features.data());
}

}  // namespace

std::vector<TubeExample> tube_examples(const Dataset& dataset, const SeenCase& seen, const Scene& told) {
  const CaseData data = read_seen_case(dataset, seen);
  const KnownScene known = told_scene(recipe_seen(dataset, seen), data, seen.scene, told);
  const Model model = with_file(data.cloud_file, [&] { return model_tubes(data.cloud, known); });
  const std::vector<std::int32_t> truth = truth_labels(data.cloud, data.cloud_file);
  PointsOn all;
  std::vector<PointsOn> on(model.tubes.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!data.cloud.mixed.empty() && data.cloud.mixed[i] != 0) continue;
    ++all[truth[i]];
    if (model.labels[i] > bin_label) ++on[static_cast<std::size_t>(model.labels[i]) - 1][truth[i]];
  }
  std::vector<TubeExample> examples;
  for (std::size_t i = 0; i < model.tubes.size(); ++i) {
    const TubeEvidence& evidence = model.evidence[i];
    examples.push_back({features_of(evidence, known), is_whole(on[i], all)});
  }
  return examples;
}

ConfidenceFeatures learn_confidence(const std::vector<TubeExample>& examples) {
  constexpr double ridge = 0.1;
  constexpr int steps = 50;
  ConfidenceFeatures weights{};
  Eigen::Map<ConfidenceVector> vector(weights.data());
  for (int i = 0; i < steps; ++i) {
    ConfidenceVector slope = -ridge * vector;
    ConfidenceMatrix curvature = ridge * ConfidenceMatrix::Identity();
    for (const auto& [features, is_right] : examples) {
      const double probability = confidence(features, weights);
      slope += ((is_right ? 1 : 0) - probability) * vector_of(features);
      curvature += probability * (1 - probability) * vector_of(features) * vector_of(features).transpose();
    }
    // Newton's step; a long one could overshoot.
    const ConfidenceVector step = curvature.ldlt().solve(slope);
    constexpr double longest = 2;
    vector += step * std::min(1.0, longest / step.norm());
  }
  return weights;
}

}  // namespace tanglebin
