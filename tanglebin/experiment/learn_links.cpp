#include "tanglebin/experiment/learn_links.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "tanglebin/model/axis/links/choose_links.hpp"

namespace tanglebin {
namespace {

using FeatureVector = Eigen::Matrix<double, link_features, 1>;

// The weights of all kinds, one after the other.
constexpr std::size_t parameters = link_kinds.size() * link_features;
using LinkVector = Eigen::Matrix<double, parameters, 1>;
using LinkMatrix = Eigen::Matrix<double, parameters, parameters>;

Eigen::Index first_of(LinkKind kind) {
  return static_cast<Eigen::Index>(kind) * static_cast<Eigen::Index>(link_features);
}

auto of_kind(auto& vector, LinkKind kind) {
  return vector.template segment<link_features>(first_of(kind));
}

Eigen::Map<const FeatureVector> features_of(const LinkExample& link) {
  return Eigen::Map<const FeatureVector>(link.features.data());
}

// ln Σ exp, relative to the largest term to avoid overflow.
double log_of_sum(const std::vector<double>& log_odds) {
  const double greatest = std::ranges::max(log_odds);
  double sum = 0;
  for (const double value : log_odds) sum += std::exp(value - greatest);
  return greatest + std::log(sum);
}

/// The log likelihood of the ends' choices, with its gradient and curvature. The curvature omits the
/// contribution of the choice between several true links, which would make it indefinite. A small penalty on
/// the squared weights keeps them finite.
struct Likelihood {
  double value = 0;
  LinkVector slope = LinkVector::Zero();
  LinkMatrix curvature = LinkMatrix::Zero();

  Likelihood(const std::vector<EndExample>& ends, const LinkVector& weights)
      : value(-ridge / 2 * weights.squaredNorm()),
        slope(-ridge * weights),
        curvature(ridge * LinkMatrix::Identity()) {
    for (const EndExample& end : ends) add(end, weights);
  }

private:
  static constexpr double ridge = 1e-3;

  void add(const EndExample& end, const LinkVector& weights) {
    std::vector<double> log_odds = {0};  // of no link, then of each link
    std::vector<double> log_odds_of_true;
    for (const LinkExample& link : end) {
      log_odds.push_back(of_kind(weights, link.kind).dot(features_of(link)));
      if (link.is_true) log_odds_of_true.push_back(log_odds.back());
    }
    if (log_odds_of_true.empty()) log_odds_of_true.push_back(log_odds.front());
    const double of_all = log_of_sum(log_odds);
    const double of_true = log_of_sum(log_odds_of_true);
    value += of_true - of_all;
    LinkVector mean = LinkVector::Zero();
    for (std::size_t i = 0; i < end.size(); ++i) {
      const FeatureVector features = features_of(end[i]);
      const double probability = std::exp(log_odds[i + 1] - of_all);
      of_kind(mean, end[i].kind) += probability * features;
      const Eigen::Index first = first_of(end[i].kind);
      curvature.block<link_features, link_features>(first, first) +=
          probability * features * features.transpose();
      if (end[i].is_true) of_kind(slope, end[i].kind) += std::exp(log_odds[i + 1] - of_true) * features;
    }
    slope -= mean;
    curvature -= mean * mean.transpose();
  }
};

bool is_small(const LinkVector& step) {
  constexpr double small = 1e-9;
  return step.cwiseAbs().maxCoeff() < small;
}

// Of the weights that are marked with 1; the others do not change.
Likelihood likelihood_of(const std::vector<EndExample>& ends, const LinkVector& weights,
                         const LinkVector& free) {
  Likelihood likelihood(ends, weights);
  likelihood.slope.array() *= free.array();
  likelihood.curvature.array() *= (free * free.transpose()).array();
  likelihood.curvature.diagonal() += LinkVector::Ones() - free;
  return likelihood;
}

// The likeliest weights, of which those are free that are marked with 1; the others are 0.
LinkVector likeliest(const std::vector<EndExample>& ends, const LinkVector& free) {
  constexpr int steps_max = 1000;
  LinkVector weights = LinkVector::Zero();
  Likelihood likelihood = likelihood_of(ends, weights, free);
  for (int i = 0; i < steps_max; ++i) {
    // Newton's step, shortened so that it does not overshoot.
    LinkVector step = likelihood.curvature.ldlt().solve(likelihood.slope);
    Likelihood next = likelihood_of(ends, weights + step, free);
    while (next.value < likelihood.value && !is_small(step)) {
      step /= 2;
      next = likelihood_of(ends, weights + step, free);
    }
    weights += step;
    likelihood = next;
    if (is_small(step)) break;
  }
  return weights;
}

constexpr Eigen::Index gap_feature = 2;

struct LearnedVector {
  LinkVector weights;
  LinkVector free;  // 1 for those that were learned; 0 for that of a gap that would make longer ones likelier
};

LearnedVector learned_from(const std::vector<EndExample>& ends) {
  LinkVector free = LinkVector::Ones();
  const LinkVector weights = likeliest(ends, free);
  for (const LinkKind kind : link_kinds) {
    if (of_kind(weights, kind)[gap_feature] > 0) free[first_of(kind) + gap_feature] = 0;
  }
  return {free == LinkVector::Ones() ? weights : likeliest(ends, free), free};
}

LinkWeights as_weights(const LinkVector& vector) {
  LinkWeights weights;
  for (const LinkKind kind : link_kinds) std::ranges::copy(of_kind(vector, kind), weights.of(kind).begin());
  return weights;
}

// All of what angles weigh counts, since it is learned where nothing tells more.
LinkSettings settings_with(const LinkVector& weights) {
  LinkSettings settings;
  settings.weights = as_weights(weights);
  settings.bent_angles = 1;
  return settings;
}

// The sum of the features of the links that are chosen among these, heaviest first. None for trees: their
// choice is greedy, so its mistakes say little of the weights.
LinkVector features_of_chosen(const LinkScene& scene, const std::vector<Link>& links,
                              const LinkSettings& settings) {
  LinkVector sum = LinkVector::Zero();
  if (scene.kind.branches()) return sum;
  for (const std::size_t i : choose_links(scene.fragments, links, scene.kind, settings, scene.seen).links) {
    const Link& link = links[i];
    of_kind(sum, link.kind) += Eigen::Map<const FeatureVector>(link.features.data());
  }
  return sum;
}

// Of the true links, as many as can be chosen together.
LinkVector features_of_true(const LinkScene& scene) {
  constexpr double certain = 1000;
  std::vector<Link> links;
  for (std::size_t i = 0; i < scene.links.size(); ++i) {
    if (!scene.is_true[i]) continue;
    links.push_back(scene.links[i]);
    links.back().weight = certain;
  }
  return features_of_chosen(scene, links, settings_with(LinkVector::Zero()));
}

// Moves the weights until the links that are chosen have, in sum over the scenes, the features of the true
// ones: the structured perceptron, with the steps of Newton's method, and the mean of the later weights.
LinkVector moved_to_true_links(const std::vector<LinkScene>& scenes, const std::vector<EndExample>& ends,
                               const LearnedVector& start) {
  constexpr int passes = 12;
  constexpr int first_of_mean = 6;
  const auto& [first, free] = start;
  const Eigen::LDLT<LinkMatrix> curvature = likelihood_of(ends, first, free).curvature.ldlt();
  LinkVector weights = first;
  LinkVector of_true = LinkVector::Zero();
  for (const LinkScene& scene : scenes) of_true += features_of_true(scene);
  LinkVector sum = LinkVector::Zero();
  for (int pass = 0; pass < passes; ++pass) {
    const LinkSettings settings = settings_with(weights);
    LinkVector of_chosen = LinkVector::Zero();
    for (const LinkScene& scene : scenes)
      of_chosen += features_of_chosen(scene, weighed(scene.links, settings), settings);
    weights += curvature.solve(free.cwiseProduct(of_true - of_chosen));
    for (const LinkKind kind : link_kinds) {
      double& of_gap = weights[first_of(kind) + gap_feature];
      of_gap = std::min(of_gap, 0.0);
    }
    if (pass >= first_of_mean) sum += weights;
  }
  return sum / (passes - first_of_mean);
}

}  // namespace

std::vector<EndExample> end_examples(const LinkScene& scene) {
  std::vector<EndExample> examples;
  std::vector<std::size_t> first_end;
  for (const Fragment& fragment : scene.fragments) {
    first_end.push_back(examples.size());
    examples.resize(examples.size() + fragment.ends.size());
  }
  for (std::size_t i = 0; i < scene.links.size(); ++i) {
    const Link& link = scene.links[i];
    const LinkExample example{link.kind, link.features, scene.is_true[i]};
    examples[first_end[link.fragment] + link.end].push_back(example);
    if (link.kind != LinkKind::junction)
      examples[first_end[link.to.fragment] + *link.to.end].push_back(example);
  }
  return examples;
}

LinkWeights likeliest_weights(const std::vector<EndExample>& ends) {
  return as_weights(learned_from(ends).weights);
}

LinkWeights learn_weights(const std::vector<LinkScene>& scenes) {
  std::vector<EndExample> ends;
  for (const LinkScene& scene : scenes) std::ranges::copy(end_examples(scene), std::back_inserter(ends));
  return as_weights(moved_to_true_links(scenes, ends, learned_from(ends)));
}

}  // namespace tanglebin
