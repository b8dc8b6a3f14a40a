#include "tanglebin/experiment/link_scenes.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "tanglebin/experiment/run.hpp"
#include "tanglebin/model/axis/axis_method.hpp"
#include "tanglebin/score/centre_line.hpp"
#include "tanglebin/score/score_clouds.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

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

// Every link is possible, any way of cutting the votes is an example, and every point has its say.
AxisSettings settings_to_learn_with() {
  constexpr double any = 1e9;
  AxisSettings settings;
  settings.vote.patch.at_every_point = true;
  settings.link.chain_prior = settings.link.tree_prior = settings.link.junction_prior = any;
  settings.fragment.sure_min = 0;
  return settings;
}

}  // namespace

std::vector<LinkScene> link_scenes(const Dataset& dataset, const SeenCase& seen) {
  const CaseData data = read_seen_case(dataset, seen);
  const KnownScene known = known_scene(recipe_seen(dataset, seen), seen.scene);
  AxisModel found = model_by_axes(data.cloud, known, 1, 0, settings_to_learn_with());
  RangeImage seen_image(data.cloud.points, known.camera, surely_solid_parts(known.support));
  seen_image.keep_measured_rows();  // learning holds hundreds of them
  std::vector<LinkScene> scenes;
  for (std::size_t i = 0; i < found.kinds.size(); ++i) {
    AxisSteps& steps = found.kinds[i];
    const TrueLinks truth(data, found.model.filtered, steps.fragments);
    std::vector<bool> is_true;
    for (const Link& link : steps.links) is_true.push_back(truth.has(link));
    scenes.push_back(
        {known.kinds[i], std::move(steps.fragments), std::move(steps.links), std::move(is_true), seen_image});
  }
  return scenes;
}

}  // namespace tanglebin
