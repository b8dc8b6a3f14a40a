#include "tanglebin/experiment/learn_links.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tanglebin/experiment/run.hpp"
#include "tanglebin/model/axis/axis_method.hpp"
#include "tanglebin/score/centre_line.hpp"
#include "tanglebin/score/score_clouds.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using FeatureVector = Eigen::Matrix<double, link_features, 1>;

/// Where the fragments of a model lie on the true tubes.
class TrueLinks {
public:
  TrueLinks(const CaseData& data, const std::vector<std::size_t>& filtered,
            const std::vector<Fragment>& fragments)
      : fragments_(fragments) {
    for (const Tube& tube : data.tubes) lines_.emplace(tube.id, CentreLine(tube));
    const std::vector<std::int32_t> labels = truth_labels(data.cloud, data.cloud_file);
    for (const Fragment& fragment : fragments_) {
      std::map<std::int32_t, int> counts;
      for (const std::size_t point : fragment.points) ++counts[labels[filtered[point]]];
      tubes_.push_back(
          std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; })->first);
      const Vector3d& middle = fragment.nodes[fragment.nodes.size() / 2];
      const bool is_on_a_tube = tubes_.back() > bin_label;
      middles_.push_back(is_on_a_tube ? lines_.at(tubes_.back()).nearest(middle).place : Place{});
    }
  }

  bool has(const Link& link) const {
    const std::size_t from = link.fragment;
    const std::size_t to = link.to.fragment;
    if (tubes_[from] <= bin_label || tubes_[from] != tubes_[to]) return false;
    const CentreLine& line = lines_.at(tubes_[from]);
    if (!leads(line, fragments_[from].ends[link.end], from, to)) return false;
    const bool is_met = link.kind == LinkKind::junction
                            ? is_as_near_as_it_seems(line, link)
                            : leads(line, fragments_[to].ends[*link.to.end], to, from);
    return is_met && is_nothing_between(line, from, to);
  }

private:
  // True if the direction out of a fragment's end leads along the tube to another fragment.
  bool leads(const CentreLine& line, const FragmentEnd& end, std::size_t from, std::size_t to) const {
    constexpr double outward = 0.004;  // m, enough to distinguish the two ends of the shortest fragment
    const Place place = line.nearest(fragments_[from].nodes[end.node] + outward * end.outward).place;
    return line.way(place, middles_[to]) < line.way(middles_[from], middles_[to]);
  }

  // True if the tube leads directly from the end to the junction, not by way of another one.
  bool is_as_near_as_it_seems(const CentreLine& line, const Link& link) const {
    constexpr double stretch = 1.3;  // a bent path is longer than the gap by up to this factor ...
    constexpr double slack = 0.005;  // ... plus this many m
    const Place end = line.nearest(fragments_[link.fragment].ends[link.end].position).place;
    const Place junction = line.nearest(link.to.position).place;
    return line.way(end, junction) <= stretch * link.gap + slack;
  }

  bool is_nothing_between(const CentreLine& line, std::size_t from, std::size_t to) const {
    constexpr double rounding = 0.0002;  // m
    const double way = line.way(middles_[from], middles_[to]);
    for (std::size_t other = 0; other < fragments_.size(); ++other) {
      if (other == from || other == to || tubes_[other] != tubes_[from]) continue;
      const Place& place = middles_[other];
      if (line.way(middles_[from], place) + line.way(place, middles_[to]) < way + rounding) return false;
    }
    return true;
  }

  const std::vector<Fragment>& fragments_;
  std::map<std::int32_t, CentreLine> lines_;
  std::vector<std::int32_t> tubes_;  // for each fragment, the true label of most of its points
  std::vector<Place> middles_;       // of each fragment on its tube; unused if it is on none
};

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

// The likeliest weights, of which those are free that are marked with 1; the others are 0.
LinkVector likeliest(const std::vector<EndExample>& ends, const LinkVector& free) {
  constexpr int steps_max = 1000;
  const auto likelihood_of = [&](const LinkVector& weights) {
    Likelihood likelihood(ends, weights);
    likelihood.slope.array() *= free.array();
    likelihood.curvature.array() *= (free * free.transpose()).array();
    likelihood.curvature.diagonal() += LinkVector::Ones() - free;
    return likelihood;
  };
  LinkVector weights = LinkVector::Zero();
  Likelihood likelihood = likelihood_of(weights);
  for (int i = 0; i < steps_max; ++i) {
    // Newton's step, shortened so that it does not overshoot.
    LinkVector step = likelihood.curvature.ldlt().solve(likelihood.slope);
    Likelihood next = likelihood_of(weights + step);
    while (next.value < likelihood.value && !is_small(step)) {
      step /= 2;
      next = likelihood_of(weights + step);
    }
    weights += step;
    likelihood = next;
    if (is_small(step)) break;
  }
  return weights;
}

}  // namespace

std::vector<EndExample> end_examples(const Dataset& dataset, const SeenCase& seen) {
  const CaseData data = read_seen_case(dataset, seen);
  AxisSettings settings;
  constexpr double any = 1e9;
  settings.link.chain_prior = settings.link.tree_prior = settings.link.junction_prior = any;
  settings.fragment.sure_min = 0;  // any way of cutting the votes is an example
  const KnownScene known = known_scene(recipe_seen(dataset, seen), seen.scene);
  const AxisModel found = model_by_axes(data.cloud, known, 1, 0, settings);
  std::vector<EndExample> examples;
  for (const AxisSteps& kind : found.kinds) {
    const TrueLinks truth(data, found.model.filtered, kind.fragments);
    std::vector<std::size_t> first_end;
    for (const Fragment& fragment : kind.fragments) {
      first_end.push_back(examples.size());
      examples.resize(examples.size() + fragment.ends.size());
    }
    for (const Link& link : kind.links) {
      const LinkExample example{link.kind, link.features, truth.has(link)};
      examples[first_end[link.fragment] + link.end].push_back(example);
      if (link.kind != LinkKind::junction)
        examples[first_end[link.to.fragment] + *link.to.end].push_back(example);
    }
  }
  return examples;
}

LinkWeights learn_weights(const std::vector<EndExample>& ends) {
  constexpr Eigen::Index gap = 2;
  LinkVector free = LinkVector::Ones();
  LinkVector weights = likeliest(ends, free);
  for (const LinkKind kind : link_kinds) free[first_of(kind) + gap] = of_kind(weights, kind)[gap] > 0 ? 0 : 1;
  if (free != LinkVector::Ones()) weights = likeliest(ends, free);
  const auto learned = [&](LinkKind kind) {
    LinkFeatures result;
    std::ranges::copy(of_kind(weights, kind), result.begin());
    return result;
  };
  return {.chain_ends = learned(LinkKind::chain_ends),
          .tree_ends = learned(LinkKind::tree_ends),
          .junction = learned(LinkKind::junction)};
}

}  // namespace tanglebin
