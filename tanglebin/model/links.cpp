#include "tanglebin/model/links.hpp"

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "tanglebin/model/angle.hpp"
#include "tanglebin/model/matching.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

constexpr double shortest = 0.002;  // m

LinkFeatures features_of(const FragmentEnd& first, const FragmentEnd& second, double radius) {
  const Vector3d way = second.position - first.position;
  const Vector3d inward = -second.outward;
  const double gap = way.norm();
  const double turn = angle_between(first.outward, inward);
  const double angle = gap < radius ? turn : angle_between(first.outward, way) + angle_between(inward, way);
  return {1, std::log(gap + shortest), gap, angle, angle * angle, turn, 0, 0};
}

/// Where a fragment may have a junction: at a node of its centre line, or beyond an end.
struct JunctionPlace {
  LinkTarget target;
  double beyond;  // m
};

LinkFeatures features_of(const FragmentEnd& end, const JunctionPlace& junction) {
  const Vector3d way = junction.target.position - end.position;
  const double gap = way.norm();
  const double angle = angle_between(end.outward, way);
  return {1, std::log(gap + shortest), gap, angle, angle * angle, junction.beyond, 0, 0};
}

std::vector<JunctionPlace> junction_places(const std::vector<Fragment>& fragments, std::size_t of,
                                           double radius, double beyond_max) {
  const Fragment& fragment = fragments[of];
  std::vector<JunctionPlace> places;
  for (std::size_t node = 0; node < fragment.nodes.size(); ++node) {
    places.push_back({{of, node, std::nullopt, fragment.nodes[node]}, 0});
  }
  constexpr double step = 0.4;  // radii
  const int steps = static_cast<int>(beyond_max / step);
  for (std::size_t i = 0; i < fragment.ends.size(); ++i) {
    const auto& [node, position, outward] = fragment.ends[i];
    for (int j = 1; j <= steps; ++j) {
      const double beyond = j * step * radius;
      places.push_back({{of, node, i, position + beyond * outward}, beyond});
    }
  }
  return places;
}

// Places among the features.
constexpr std::size_t alpha = 3;
constexpr std::size_t seen_empty = 6;
constexpr std::size_t openness = 7;

double prior(LinkKind kind, const LinkSettings& settings) {
  switch (kind) {
    case LinkKind::chain_ends:
      return settings.chain_prior;
    case LinkKind::tree_ends:
      return settings.tree_prior;
    case LinkKind::junction:
      return settings.junction_prior;
  }
  return 0;
}

double weight_of(const Link& link, const LinkSettings& settings) {
  const LinkFeatures& weights = learned_weights.of(link.kind);
  return prior(link.kind, settings) + ends_taken(link.kind) * std::inner_product(weights.begin(),
                                                                                 weights.end(),
                                                                                 link.features.begin(), 0.0);
}

// The cubic Hermite curve from one end to the other, at t in [0, 1].
Vector3d on_curve(const FragmentEnd& first, const FragmentEnd& second, double t) {
  const double gap = (second.position - first.position).norm();
  const double s = 1 - t;
  return (1 + 2 * t) * s * s * first.position + t * s * s * gap * first.outward +
         t * t * (3 - 2 * t) * second.position + t * t * s * gap * second.outward;
}

// The share of the way between two ends on which the sensor saw past a tube, straight or curved, whichever is
// hidden better.
double share_seen_empty(const FragmentEnd& first, const FragmentEnd& second, const RangeImage& seen,
                        double radius) {
  const Vector3d way = second.position - first.position;
  constexpr double step = 0.4;  // radii
  const int samples = std::max(1, static_cast<int>(way.norm() / (step * radius)) - 1);
  int straight = 0;
  int curved = 0;
  for (int i = 1; i <= samples; ++i) {
    const double t = static_cast<double>(i) / (samples + 1);
    if (seen.shows_empty(first.position + t * way, radius)) ++straight;
    if (seen.shows_empty(on_curve(first, second, t), radius)) ++curved;
  }
  return static_cast<double>(std::min(straight, curved)) / samples;
}

// 1 where a fragment ends for all to see, 0 where what covers it goes on.
double openness_of(const FragmentEnd& end, const RangeImage& seen, double radius) {
  constexpr std::array distances = {1.5, 2.0, 2.5, 3.0};  // radii
  const auto is_empty = [&](double distance) {
    return seen.shows_empty(end.position + distance * radius * end.outward, radius);
  };
  return static_cast<double>(std::ranges::count_if(distances, is_empty)) /
         static_cast<double>(distances.size());
}

/// What is known of a piece of a tube.
struct Piece {
  double length;  // m
  int ends;
};

/// The tubes that links make of fragments.
class Tubes {
public:
  Tubes(const std::vector<Fragment>& fragments, const TubeKind& kind, const LinkSettings& settings)
      : sets_(fragments.size()),
        length_max_(kind.length * (1 + settings.length_tolerance)),
        arm_min_(kind.length * settings.arm_min),
        ends_(kind.junctions + 2),
        ends_max_(ends_ + settings.ends_tolerance) {
    pieces_.reserve(fragments.size());
    for (const Fragment& fragment : fragments) {
      pieces_.push_back({fragment.length, static_cast<int>(fragment.ends.size())});
    }
  }

  // Whether a link leaves the tube open, and no longer than known and with no more ends than its junctions
  // give it. An arm that is missing has a length too.
  bool allow(const Link& link) {
    const std::size_t first = sets_.find_set(link.fragment);
    const std::size_t second = sets_.find_set(link.to.fragment);
    if (first == second) return false;
    const Piece piece = joined(pieces_[first], pieces_[second], link);
    const double missing = arm_min_ * std::max(0, ends_ - piece.ends);
    return piece.length + missing <= length_max_ && piece.ends <= ends_max_;
  }

  void join(const Link& link) {
    const std::size_t first = sets_.find_set(link.fragment);
    const std::size_t second = sets_.find_set(link.to.fragment);
    const Piece piece = joined(pieces_[first], pieces_[second], link);
    sets_.union_set(first, second);
    pieces_[sets_.find_set(first)] = piece;
  }

private:
  static Piece joined(const Piece& first, const Piece& second, const Link& link) {
    return {first.length + link.gap + second.length, first.ends + second.ends - ends_taken(link.kind)};
  }

  boost::disjoint_sets_with_storage<> sets_;
  double length_max_;
  double arm_min_;
  int ends_;
  int ends_max_;
  std::vector<Piece> pieces_;  // the tube that a set stands for
};

/// What links there may be between some fragments, and how heavy they are.
struct Candidates {
  const std::vector<Fragment>& fragments;
  const std::vector<Link>& links;
  const std::vector<WeightedPair>& pairs;  ///< a link's two ends as vertices, and its weight
  std::size_t vertices;
  const TubeKind& kind;
  const LinkSettings& settings;
};

/// Links of which no two share an end, and that together make possible tubes only.
class Selection {
public:
  explicit Selection(const Candidates& candidates)
      : candidates_(&candidates),
        tubes_(candidates.fragments, candidates.kind, candidates.settings),
        used_(candidates.vertices) {}

  /// Takes a link where that is possible, and says whether it is.
  bool take(std::size_t link) {
    const auto& [first, second, weight] = candidates_->pairs[link];
    if (used_[first] || used_[second] || !tubes_.allow(candidates_->links[link])) return false;
    tubes_.join(candidates_->links[link]);
    used_[first] = used_[second] = true;
    weight_ += weight;
    taken_.push_back(link);
    return true;
  }

  /// Takes these links, one after the other, where that is possible.
  void take_possible(const std::vector<std::size_t>& links) {
    for (const std::size_t link : links) take(link);
  }

  bool has_a_free_end(std::size_t link) const {
    const auto& [first, second, weight] = candidates_->pairs[link];
    return !used_[first] || !used_[second];
  }

  const std::vector<std::size_t>& taken() const { return taken_; }
  double weight() const { return weight_; }

private:
  const Candidates* candidates_;
  Tubes tubes_;
  std::vector<bool> used_;
  std::vector<std::size_t> taken_;
  double weight_ = 0;
};

std::vector<std::size_t> heaviest_first(const std::vector<std::size_t>& links,
                                        const std::vector<WeightedPair>& pairs) {
  std::vector<std::size_t> order = links;
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return pairs[i].weight; });
  return order;
}

// Goes on to a heavier selection as long as there is one that has a link which was left out so far, what can
// be kept beside that, and the heaviest of the others. `order` has all links, the heaviest first.
Selection exchanged(Selection best, const std::vector<std::size_t>& order, const Candidates& candidates) {
  constexpr double rounding = 1e-9;
  const Selection none(candidates);
  for (bool is_better = true; is_better;) {
    is_better = false;
    for (const std::size_t i : order) {
      if (!best.has_a_free_end(i)) continue;
      Selection other = none;
      other.take(i);
      other.take_possible(best.taken());
      other.take_possible(order);
      if (other.weight() <= best.weight() + rounding) continue;
      best = std::move(other);
      is_better = true;
    }
  }
  return best;
}

// The links that make one of the tubes impossible: of each such tube the weakest. They are found by taking
// the links of the matching one after the other, the heaviest first.
std::vector<std::size_t> impossible_links(const std::vector<std::size_t>& matching,
                                          const Candidates& candidates) {
  Selection possible(candidates);
  std::vector<std::size_t> impossible;
  for (const std::size_t i : heaviest_first(matching, candidates.pairs)) {
    if (!possible.take(i)) impossible.push_back(i);
  }
  return impossible;
}

// A matching of greatest weight between the ends in which every tube is possible: what makes one impossible
// is given up, and the rest matched again.
std::vector<std::size_t> possible_matching(const Candidates& candidates) {
  std::vector<WeightedPair> pairs = candidates.pairs;
  for (;;) {
    std::vector<std::size_t> matching = heaviest_matching(candidates.vertices, pairs);
    const std::vector<std::size_t> impossible = impossible_links(matching, candidates);
    if (impossible.empty()) return matching;
    for (const std::size_t i : impossible) pairs[i].weight = 0;
  }
}

/// Finds links between two fragments.
class LinkFinder {
public:
  LinkFinder(const std::vector<Fragment>& fragments, const RangeImage& seen, const TubeKind& kind,
             const LinkSettings& settings)
      : fragments_(fragments), seen_(seen), kind_(kind), settings_(settings) {
    for (const Fragment& fragment : fragments) {
      std::vector<double>& of_ends = openness_.emplace_back();
      for (const FragmentEnd& end : fragment.ends) of_ends.push_back(openness_of(end, seen, kind.radius));
    }
    if (kind.junctions == 0) return;
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      places_.push_back(junction_places(fragments, i, kind.radius, settings.beyond_max));
    }
  }

  void between_ends(std::size_t first, std::size_t second) {
    const Fragment& f = fragments_[first];
    const Fragment& g = fragments_[second];
    for (std::size_t i = 0; i < f.ends.size(); ++i) {
      for (std::size_t j = 0; j < g.ends.size(); ++j) {
        const double gap = (g.ends[j].position - f.ends[i].position).norm();
        if (!may_span(gap, f, g)) continue;
        take_if_likely({kind_.junctions > 0 ? LinkKind::tree_ends : LinkKind::chain_ends,
                        first,
                        i,
                        {second, g.ends[j].node, j, g.ends[j].position},
                        gap,
                        features_of(f.ends[i], g.ends[j], kind_.radius)},
                       f.ends[i], g.ends[j]);
      }
    }
  }

  // To the other fragment's place of the least cost, as the paper's method weighs joins (Section 4).
  void to_junction(std::size_t first, std::size_t second) {
    const Fragment& f = fragments_[first];
    const double metres_for_a_radian = settings_.gap_max / settings_.angle_max;
    for (std::size_t i = 0; i < f.ends.size(); ++i) {
      const FragmentEnd& end = f.ends[i];
      const auto cost = [&](const JunctionPlace& place) {
        const Vector3d way = place.target.position - end.position;
        return way.norm() + place.beyond + metres_for_a_radian * angle_between(end.outward, way);
      };
      const JunctionPlace& cheapest = *std::ranges::min_element(places_[second], {}, cost);
      const Vector3d way_back = end.position - cheapest.target.position;
      if (!may_span(way_back.norm(), f, fragments_[second])) continue;
      take_if_likely(
          {LinkKind::junction, first, i, cheapest.target, way_back.norm(), features_of(end, cheapest)}, end,
          {cheapest.target.node, cheapest.target.position, way_back.normalized()});
    }
  }

  std::vector<Link> found() { return std::move(links_); }

private:
  bool may_span(double gap, const Fragment& first, const Fragment& second) const {
    return gap <= settings_.gap_max &&
           first.length + gap + second.length <= kind_.length * (1 + settings_.length_tolerance);
  }

  void take_if_likely(Link link, const FragmentEnd& from, const FragmentEnd& to) {
    if (link.features[alpha] > settings_.angle_max) return;
    link.features[openness] = mean_openness(link);
    // What was seen to be empty makes it less likely, and takes the most time to know.
    if (weight_of(link, settings_) <= 0) return;
    link.features[seen_empty] = share_seen_empty(from, to, seen_, kind_.radius);
    if (link.features[seen_empty] > settings_.seen_empty_max || weight_of(link, settings_) <= 0) return;
    links_.push_back(link);
  }

  double mean_openness(const Link& link) const {
    const double of_first = openness_[link.fragment][link.end];
    if (link.kind == LinkKind::junction) return of_first;
    return (of_first + openness_[link.to.fragment][*link.to.end]) / 2;
  }

  const std::vector<Fragment>& fragments_;
  const RangeImage& seen_;
  const TubeKind& kind_;
  const LinkSettings& settings_;
  std::vector<std::vector<double>> openness_;       // of each fragment's ends
  std::vector<std::vector<JunctionPlace>> places_;  // of each fragment
  std::vector<Link> links_;
};

}  // namespace

const LinkFeatures& LinkWeights::of(LinkKind kind) const {
  switch (kind) {
    case LinkKind::chain_ends:
      return chain_ends;
    case LinkKind::tree_ends:
      return tree_ends;
    case LinkKind::junction:
      break;
  }
  return junction;
}

std::vector<Link> find_links(const std::vector<Fragment>& fragments, const RangeImage& seen,
                             const TubeKind& kind, const LinkSettings& settings) {
  LinkFinder finder(fragments, seen, kind, settings);
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    for (std::size_t j = 0; j < fragments.size(); ++j) {
      if (i < j) finder.between_ends(i, j);
      if (i != j && kind.junctions > 0) finder.to_junction(i, j);
    }
  }
  return finder.found();
}

std::vector<std::size_t> choose_links(const std::vector<Fragment>& fragments, const std::vector<Link>& links,
                                      const TubeKind& kind, const LinkSettings& settings) {
  // The graph has a vertex for each end, and one more that stands for the junction that the end may lead to.
  std::vector<std::size_t> ends_before{0};
  for (const Fragment& fragment : fragments) ends_before.push_back(ends_before.back() + fragment.ends.size());
  const std::size_t ends = ends_before.back();
  std::vector<WeightedPair> pairs;
  pairs.reserve(links.size());
  for (const Link& link : links) {
    const std::size_t from = ends_before[link.fragment] + link.end;
    const bool leads_to_junction = link.kind == LinkKind::junction;
    const std::size_t to = leads_to_junction ? ends + from : ends_before[link.to.fragment] + *link.to.end;
    pairs.push_back({from, to, weight_of(link, settings)});
  }
  const Candidates candidates{fragments, links, pairs, 2 * ends, kind, settings};
  std::vector<std::size_t> all(links.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::vector<std::size_t> order = heaviest_first(all, pairs);

  Selection selection(candidates);
  // Three ends meet at a junction: a matching, which pairs them, finds chains only.
  if (kind.junctions == 0) selection.take_possible(possible_matching(candidates));
  selection.take_possible(order);
  std::vector<std::size_t> chosen = exchanged(std::move(selection), order, candidates).taken();
  std::ranges::sort(chosen);
  return chosen;
}

std::vector<std::vector<std::size_t>> linked_fragments(std::size_t fragments, const std::vector<Link>& links,
                                                       const std::vector<std::size_t>& chosen) {
  boost::disjoint_sets_with_storage<> tubes(fragments);
  for (const std::size_t i : chosen) tubes.union_set(links[i].fragment, links[i].to.fragment);
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < fragments; ++i) members[tubes.find_set(i)].push_back(i);
  std::vector<std::vector<std::size_t>> result;
  result.reserve(members.size());
  for (auto& [tube, list] : members) result.push_back(std::move(list));
  std::ranges::sort(result);
  return result;
}

}  // namespace tanglebin
