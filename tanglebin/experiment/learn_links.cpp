#include "tanglebin/experiment/learn_links.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>

#include "tanglebin/experiment/run.hpp"
#include "tanglebin/model/axis_method.hpp"
#include "tanglebin/score/centre_line.hpp"
#include "tanglebin/score/score_clouds.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;
using FeatureVector = Eigen::Matrix<double, link_features, 1>;
using FeatureMatrix = Eigen::Matrix<double, link_features, link_features>;

/// Where the fragments of a model are on the true tubes.
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
  // Whether the way out of a fragment's end is the way along the tube to another fragment.
  bool leads(const CentreLine& line, const FragmentEnd& end, std::size_t from, std::size_t to) const {
    constexpr double outward = 0.004;  // m, enough to tell the two ends of the shortest fragment apart
    const Place place = line.nearest(fragments_[from].nodes[end.node] + outward * end.outward).place;
    return line.way(place, middles_[to]) < line.way(middles_[from], middles_[to]);
  }

  // Whether the tube leads from the end straight to the junction, not by another one.
  bool is_as_near_as_it_seems(const CentreLine& line, const Link& link) const {
    constexpr double stretch = 1.3;  // a bent way is longer than the gap, by so much ...
    constexpr double slack = 0.005;  // ... and so many m
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
  std::vector<std::int32_t> tubes_;  // the true label of most points of each fragment
  std::vector<Place> middles_;       // of each fragment on its tube; of one on none, nothing
};

LinkFeatures logistic_regression(const std::vector<LinkExample>& examples, LinkKind kind) {
  constexpr double ridge = 1e-3;
  constexpr double small_step = 1e-9;
  constexpr int steps_max = 100;
  FeatureVector weights = FeatureVector::Zero();
  for (int i = 0; i < steps_max; ++i) {
    FeatureVector gradient = ridge * weights;
    FeatureMatrix curvature = ridge * FeatureMatrix::Identity();
    for (const LinkExample& example : examples) {
      if (example.kind != kind) continue;
      const auto features = Eigen::Map<const FeatureVector>(example.features.data());
      const double likelihood = 1 / (1 + std::exp(-weights.dot(features)));
      gradient += (likelihood - (example.is_true ? 1 : 0)) * features;
      curvature += likelihood * (1 - likelihood) * features * features.transpose();
    }
    const FeatureVector step = curvature.ldlt().solve(gradient);
    weights -= step;
    if (step.cwiseAbs().maxCoeff() < small_step) break;
  }
  LinkFeatures result;
  std::ranges::copy(weights, result.begin());
  return result;
}

}  // namespace

std::vector<LinkExample> link_examples(const Dataset& dataset, const CaseId& id) {
  const CaseData data = read_case(dataset, id);
  AxisSettings settings;
  constexpr double any = 1e9;
  settings.link.chain_prior = settings.link.tree_prior = settings.link.junction_prior = any;
  const AxisModel found = model_by_axes(data.cloud, known_scene(recipe_of(dataset, id), id), 1, 0, settings);
  std::vector<LinkExample> examples;
  for (const AxisSteps& kind : found.kinds) {
    const TrueLinks truth(data, found.model.filtered, kind.fragments);
    for (const Link& link : kind.links) examples.push_back({link.kind, link.features, truth.has(link)});
  }
  return examples;
}

LinkWeights learn_weights(const std::vector<LinkExample>& examples) {
  return {.chain_ends = logistic_regression(examples, LinkKind::chain_ends),
          .tree_ends = logistic_regression(examples, LinkKind::tree_ends),
          .junction = logistic_regression(examples, LinkKind::junction)};
}

}  // namespace tanglebin
