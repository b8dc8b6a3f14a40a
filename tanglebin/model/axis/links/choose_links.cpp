#include "tanglebin/model/axis/links/choose_links.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <unordered_map>
#include <utility>

#include "tanglebin/model/axis/links/assemble.hpp"
#include "tanglebin/model/axis/links/beyond_ends.hpp"
#include "tanglebin/model/axis/links/line_tree.hpp"
#include "tanglebin/model/axis/links/matching.hpp"
#include "tanglebin/model/axis/links/tube_shapes.hpp"

namespace tanglebin {
namespace {

/// A part of a tube: one fragment, or several with the links between them.
struct Part {
  double length;  ///< m
  int ends;
  std::uint64_t links;  ///< sum of the random numbers of its links
  double hidden;        ///< m, how far it may go on unseen beyond its ends
  double cost;          ///< of its shape, in log odds
};

/// The input of the choice.
struct Candidates {
  const std::vector<Fragment>& fragments;
  const std::vector<Link>& links;  ///< heaviest first
  const TubeKind& kind;
  const LinkSettings& settings;
  const RangeImage& seen;
  double tube_length_max = length_max(kind.length(), settings);  ///< m
  int tube_ends_max = count_ends(kind.segments) + settings.ends_tolerance;
  std::vector<WeightedPair> pairs = {};  ///< the two ends of each link as vertices, and its weight
  std::size_t vertices = 0;
  std::vector<std::vector<std::size_t>> links_of = {};  ///< for each fragment, those that have an end there
  std::vector<std::uint64_t> numbers = {};  ///< random, one per link; no two sets of links have the same sum
  std::vector<Part> alone = {};             ///< each fragment by itself
  TubeShapes shapes = {};                   ///< what chains look like
};

// The cost of what a part of a chain lacks, more than can be hidden beyond its ends. It may have been
// misjudged that an end is free, so the cost has a limit. What trees and bent chains lack is a part of the
// cost of their shape.
double cost_of_length(const Candidates& candidates, const Part& chain) {
  constexpr double cost_max = 10;
  if (candidates.kind.branches() || candidates.shapes.are_bent()) return 0;
  const double unseen = unseen_length(chain.length, chain.hidden, candidates.kind, candidates.settings);
  return std::clamp(unseen / (candidates.settings.unseen_unit * candidates.kind.radius), 0.0, cost_max);
}

// The centre line of a chain: these fragments with the chosen links between them.
CentrePath centre_path(const Candidates& candidates, const std::vector<std::size_t>& fragments,
                       const std::vector<std::size_t>& chosen) {
  const LineTree line =
      assembled_line(candidates.fragments, fragments, candidates.links, chosen, candidates.kind.radius);
  const Paths paths(line);
  CentrePath path;
  for (const std::size_t node : paths.all().front()) path.push_back(line.nodes[node]);
  return path;
}

// The cost of looking unlike the whole chains of the scan.
double cost_of_looks(const Candidates& candidates, const CentrePath& chain) {
  constexpr double cost_max = 20;
  const double ordinary = candidates.settings.strangeness_max;
  const double strangeness = candidates.shapes.strangeness(chain, ordinary) - ordinary;
  return std::clamp(candidates.settings.strangeness_weight * strangeness, 0.0, cost_max);
}

// The cost of looking unlike the whole, bent chains of the scan, and of what was seen to be empty where the
// rest of such a chain must be. Of all ways to lay a whole chain on this one, the one that costs least
// counts.
double cost_of_bent(const Candidates& candidates, const CentrePath& chain) {
  constexpr double cost_max = 40;
  constexpr double slack = 2;  // radii
  constexpr double near = 1.6;
  const LinkSettings& settings = candidates.settings;
  const double radius = candidates.kind.radius;
  if (path_length(chain) < slack * radius) return 0;
  const auto of_empty = [&](int places) {
    return std::clamp(settings.bent_empty * (places * TubeShapes::step - slack), 0.0, cost_max);
  };
  double least = 2 * cost_max;
  candidates.shapes.lay_on(chain, [&](const TubeShapes::Laid& laid) {
    const double of_looks =
        std::clamp(settings.bent_weight * (laid.strangeness - settings.strangeness_max), 0.0, cost_max);
    if (of_looks >= least) return true;
    int empty = 0;
    for (const Eigen::Vector3d& place : candidates.shapes.rest_of(laid, near * radius)) {
      if (candidates.seen.shows_empty(place, radius)) ++empty;
      if (of_looks + of_empty(empty) >= least) return true;
    }
    least = of_looks + of_empty(empty);
    return least > 0;
  });
  return least;
}

// The shape cost of a part of a tree: these fragments with the chosen links between them. If much of the tree
// is missing, either that much is occluded or the part is no tree at all; the cheaper explanation counts.
double cost_of_tree(const Candidates& candidates, const std::vector<std::size_t>& fragments,
                    const std::vector<std::size_t>& chosen) {
  const TubeKind& kind = candidates.kind;
  const SegmentTree seen =
      segments_of(assembled_line(candidates.fragments, fragments, candidates.links, chosen, kind.radius));
  const double length = total_length(seen);
  const double missing = std::min(length, std::max(0.0, kind.length() - length));
  return misfit(seen, kind.segments) / (candidates.settings.misfit_unit * kind.radius) +
         missing / (candidates.settings.missing_unit * kind.radius);
}

bool has_shape_costs(const Candidates& candidates) {
  return candidates.kind.branches() || candidates.shapes.are_known();
}

// The shape cost of a part: these fragments with the chosen links between them.
double shape_cost(const Candidates& candidates, const std::vector<std::size_t>& fragments,
                  const std::vector<std::size_t>& chosen) {
  if (candidates.kind.branches()) return cost_of_tree(candidates, fragments, chosen);
  const CentrePath chain = centre_path(candidates, fragments, chosen);
  return candidates.shapes.are_bent() ? cost_of_bent(candidates, chain) : cost_of_looks(candidates, chain);
}

/// A set of links in which no two share an end and every tube is possible.
class Selection {
public:
  /// Shape costs already computed, keyed by Part::links.
  using Costs = std::unordered_map<std::uint64_t, double>;

  Selection(const Candidates& candidates, Costs& costs)
      : candidates_(&candidates),
        costs_(&costs),
        tubes_(candidates.fragments.size()),
        parts_(candidates.alone),
        used_(candidates.vertices) {
    std::iota(tubes_.begin(), tubes_.end(), std::size_t{0});
  }

  /// Takes a link if its ends are free and the resulting tube is possible and likelier than its two parts.
  /// Returns true if it did.
  bool take(std::size_t link) {
    const auto [first, second] = tubes_of(link);
    if (first == second) return false;
    Part tube = joined(first, second, link);
    if (tube.length > candidates_->tube_length_max || tube.ends > candidates_->tube_ends_max) return false;
    const auto& [from, to, weight] = candidates_->pairs[link];
    const double worth = weight + parts_[first].cost + parts_[second].cost;
    tube.cost = cost_of_length(*candidates_, tube);
    if (worth <= tube.cost) return false;  // whatever its shape costs
    if (has_shape_costs(*candidates_)) tube.cost += cost_of_shape(tube, first, second, link);
    if (worth <= tube.cost) return false;
    std::ranges::replace(tubes_, second, first);
    parts_[first] = tube;
    used_[from] = used_[to] = 1;
    taken_.push_back(link);
    return true;
  }

  /// Takes as many of these links as possible, in order.
  void take_possible(const std::vector<std::size_t>& links) {
    for (const std::size_t link : links) {
      if (has_free_ends(link)) take(link);  // usually false
    }
  }

  /// What was a tube, or two, before it was given up.
  struct Released {
    std::vector<std::size_t> fragments;
    std::vector<std::size_t> links;  ///< heaviest first
  };

  /// Gives up the tubes that a link would join.
  Released release_tubes_of(std::size_t link) {
    const std::pair<std::size_t, std::size_t> tubes = tubes_of(link);
    const auto is_theirs = [&](std::size_t fragment) {
      return tubes_[fragment] == tubes.first || tubes_[fragment] == tubes.second;
    };
    Released released;
    std::erase_if(taken_, [&](std::size_t i) {
      if (!is_theirs(candidates_->links[i].fragment)) return false;
      released.links.push_back(i);
      used_[candidates_->pairs[i].first] = used_[candidates_->pairs[i].second] = 0;
      return true;
    });
    std::ranges::sort(released.links);
    for (std::size_t i = 0; i < tubes_.size(); ++i) {
      if (is_theirs(i)) released.fragments.push_back(i);
    }
    for (const std::size_t i : released.fragments) {
      tubes_[i] = i;
      parts_[i] = candidates_->alone[i];
    }
    return released;
  }

  bool has_free_ends(std::size_t link) const {
    const WeightedPair& pair = candidates_->pairs[link];
    return (used_[pair.first] | used_[pair.second]) == 0;
  }

  /// Whether a tube is represented by this fragment.
  bool represents(std::size_t fragment) const { return tubes_[fragment] == fragment; }

  /// Of the tube that a fragment is part of.
  double cost_of_tube(std::size_t fragment) const { return parts_[tubes_[fragment]].cost; }

  const std::vector<std::size_t>& taken() const { return taken_; }

  /// The sum of the links' weights, less the costs of the tubes: log odds.
  double weight() const {
    double sum = 0;
    for (const std::size_t i : taken_) sum += candidates_->pairs[i].weight;
    for (std::size_t i = 0; i < tubes_.size(); ++i) {
      if (represents(i)) sum -= cost_of_tube(i);
    }
    return sum;
  }

private:
  // Each is represented by one of its fragments.
  std::pair<std::size_t, std::size_t> tubes_of(std::size_t link) const {
    const Link& its = candidates_->links[link];
    return {tubes_[its.fragment], tubes_[its.to.fragment]};
  }

  Part joined(std::size_t first, std::size_t second, std::size_t link) const {
    const Part& a = parts_[first];
    const Part& b = parts_[second];
    const Link& its = candidates_->links[link];
    return {.length = a.length + its.gap + b.length,
            .ends = a.ends + b.ends - ends_taken(its.kind),
            .links = a.links + b.links + candidates_->numbers[link],
            .hidden = a.hidden + b.hidden - hidden_beyond(its),
            .cost = 0};
  }

  // Beyond the ends that a link takes, m.
  double hidden_beyond(const Link& link) const {
    const std::vector<Fragment>& fragments = candidates_->fragments;
    const double from = fragments[link.fragment].ends[link.end].hidden;
    return ends_taken(link.kind) == 1 ? from : from + fragments[link.to.fragment].ends[*link.to.end].hidden;
  }

  double cost_of_shape(const Part& tube, std::size_t first, std::size_t second, std::size_t link) {
    const auto weighed = costs_->find(tube.links);
    if (weighed != costs_->end()) return weighed->second;
    std::vector<std::size_t> fragments;
    for (std::size_t i = 0; i < candidates_->fragments.size(); ++i) {
      if (tubes_[i] == first || tubes_[i] == second) fragments.push_back(i);
    }
    std::vector<std::size_t> chosen = taken_;
    chosen.push_back(link);
    std::ranges::sort(chosen);
    return (*costs_)[tube.links] = shape_cost(*candidates_, fragments, chosen);
  }

  const Candidates* candidates_;
  Costs* costs_;
  std::vector<std::size_t> tubes_;  // for each fragment, the one that represents its tube
  std::vector<Part> parts_;         // for each fragment that represents a tube
  std::vector<std::uint8_t> used_;  // for each vertex; bytes are faster to read than bits
  std::vector<std::size_t> taken_;
};

// Keeps what it can of `kept`, then adds the heaviest of the other links.
Selection completed(Selection selection, const std::vector<std::size_t>& kept,
                    const std::vector<std::size_t>& others) {
  selection.take_possible(kept);
  selection.take_possible(others);
  return selection;
}

// The links of these fragments whose ends are free, heaviest first.
std::vector<std::size_t> free_links_of(const std::vector<std::size_t>& fragments, const Selection& selection,
                                       const Candidates& candidates) {
  std::vector<std::size_t> free;
  for (const std::size_t fragment : fragments) {
    std::ranges::copy_if(candidates.links_of[fragment], std::back_inserter(free),
                         [&](std::size_t link) { return selection.has_free_ends(link); });
  }
  std::ranges::sort(free);
  return free;
}

// The most that a selection can weigh with some of these links, each of which has an end on these fragments.
// An end has one link at most, so each end counts with its heaviest one; of a link between two of the
// fragments, with a half. What tubes cost now, larger ones need not.
double most_with(const Selection& selection, const std::vector<std::size_t>& fragments,
                 const std::vector<std::size_t>& links, const Candidates& candidates) {
  double sum = selection.weight();
  for (const std::size_t i : fragments) {
    if (selection.represents(i)) sum += selection.cost_of_tube(i);
  }
  std::vector<double> most(candidates.vertices);
  const auto raise = [&](std::size_t vertex, double weight) {
    sum += std::max(weight - most[vertex], 0.0);
    most[vertex] = std::max(weight, most[vertex]);
  };
  const auto is_theirs = [&](std::size_t fragment) {
    return std::ranges::binary_search(fragments, fragment);
  };
  for (const std::size_t i : links) {
    const auto& [from, to, weight] = candidates.pairs[i];
    const std::size_t first = candidates.links[i].fragment;
    const std::size_t second = candidates.links[i].to.fragment;
    if (!is_theirs(second)) {
      raise(from, weight + selection.cost_of_tube(second));
    } else if (!is_theirs(first)) {
      raise(to, weight + selection.cost_of_tube(first));
    } else {
      raise(from, weight / 2);
      raise(to, weight / 2);
    }
  }
  return sum;
}

// Repeatedly moves to a heavier selection: one that contains a given link, whatever can be kept of the tubes
// that it joins, and the heaviest of the other links of their fragments. A single link rarely repairs a tree
// made of parts of two, so this also tries to rebuild both from nothing. A try looks at every fragment, so
// there is a limit to the tries where there are many: thousands of pieces of noise.
Selection exchanged(const Candidates& candidates, Selection best, const std::vector<std::size_t>& all) {
  constexpr double rounding = 1e-9;
  constexpr std::size_t looks_max = 100'000'000;
  std::size_t tries_left = looks_max / std::max<std::size_t>(candidates.fragments.size(), 1);
  std::size_t in_vain = 0;  // links tried since the last exchange
  double weight = best.weight();
  Selection with_link = best;
  for (std::size_t i = 0; in_vain < all.size() && tries_left > 0; i = (i + 1) % all.size(), --tries_left) {
    ++in_vain;
    with_link = best;
    const Selection::Released released = with_link.release_tubes_of(i);
    if (!with_link.take(i)) continue;
    const std::vector<std::size_t> others = free_links_of(released.fragments, with_link, candidates);
    if (most_with(with_link, released.fragments, others, candidates) <= weight) continue;  // as nearly always
    Selection other = completed(with_link, released.links, others);
    if (candidates.kind.branches()) {
      Selection anew = completed(with_link, {}, others);
      if (anew.weight() > other.weight()) other = std::move(anew);
    }
    if (other.weight() <= weight + rounding) continue;
    best = completed(std::move(other), {}, all);
    weight = best.weight();
    in_vain = 0;
  }
  return best;
}

// The weakest link of each impossible tube.
std::vector<std::size_t> impossible_links(const std::vector<std::size_t>& matching, Selection possible) {
  std::vector<std::size_t> impossible;
  for (const std::size_t i : matching) {
    if (!possible.take(i)) impossible.push_back(i);
  }
  return impossible;
}

// A maximum-weight matching of the ends with only possible tubes: drops the links that make a tube
// impossible, and matches the rest again.
std::vector<std::size_t> possible_matching(const Candidates& candidates, const Selection& none) {
  std::vector<WeightedPair> pairs = candidates.pairs;
  for (;;) {
    std::vector<std::size_t> matching = heaviest_matching(candidates.vertices, pairs);
    const std::vector<std::size_t> impossible = impossible_links(matching, none);
    if (impossible.empty()) return matching;
    for (const std::size_t i : impossible) pairs[i].weight = 0;
  }
}

// The graph has a vertex for each end, and one for the junction that each end may lead to.
void add_graph(Candidates& candidates) {
  std::vector<std::size_t> ends_before{0};
  for (const Fragment& fragment : candidates.fragments)
    ends_before.push_back(ends_before.back() + fragment.ends.size());
  const std::size_t ends = ends_before.back();
  candidates.vertices = 2 * ends;
  candidates.links_of.resize(candidates.fragments.size());
  candidates.pairs.reserve(candidates.links.size());
  for (const Link& link : candidates.links) {
    const std::size_t from = ends_before[link.fragment] + link.end;
    const bool leads_to_junction = link.kind == LinkKind::junction;
    const std::size_t to = leads_to_junction ? ends + from : ends_before[link.to.fragment] + *link.to.end;
    for (const std::size_t fragment : {link.fragment, link.to.fragment})
      candidates.links_of[fragment].push_back(candidates.pairs.size());
    candidates.pairs.push_back({from, to, link.weight});
  }
}

void add_numbers(Candidates& candidates) {
  std::mt19937_64 random;
  for (std::size_t i = 0; i < candidates.links.size(); ++i) candidates.numbers.push_back(random());
}

void add_parts(Candidates& candidates) {
  candidates.alone.clear();
  for (std::size_t i = 0; i < candidates.fragments.size(); ++i) {
    const Fragment& fragment = candidates.fragments[i];
    const int ends = static_cast<int>(fragment.ends.size());
    double hidden = 0;
    for (const FragmentEnd& end : fragment.ends) hidden += end.hidden;
    Part part{.length = fragment.length, .ends = ends, .links = 0, .hidden = hidden, .cost = 0};
    part.cost = cost_of_length(candidates, part);
    // With surplus ends a piece of a tree stays a tube by itself, at no cost.
    if (has_shape_costs(candidates) && ends <= candidates.tube_ends_max)
      part.cost += shape_cost(candidates, {i}, {});
    candidates.alone.push_back(part);
  }
}

// Of the links between these fragments, the weakest; infinite if there is none.
double weakest_link(const Candidates& candidates, const std::vector<std::size_t>& fragments,
                    const std::vector<std::size_t>& chosen) {
  double weakest = std::numeric_limits<double>::infinity();
  for (const std::size_t i : chosen) {
    if (std::ranges::binary_search(fragments, candidates.links[i].fragment))
      weakest = std::min(weakest, candidates.links[i].weight);
  }
  return weakest;
}

// What the whole chains among the chosen look like. Without a known length, none is known to be whole. If too
// few are alike, some may be wrong: then only those without a doubtful link count, if they are bent, since
// bent ones are not alike by chance.
TubeShapes shapes_of_whole_chains(const Candidates& candidates, const std::vector<std::size_t>& chosen) {
  constexpr double nearly = 0.05;  // of the length
  constexpr double sure = 15;      // log odds
  constexpr std::size_t enough = 3;
  constexpr std::size_t enough_sure_ones = 2;
  const TubeKind& kind = candidates.kind;
  std::vector<CentrePath> whole;
  std::vector<CentrePath> sure_ones;
  if (kind.length_min <= 0) return {};
  for (const auto& members : linked_fragments(candidates.fragments.size(), candidates.links, chosen)) {
    CentrePath path = centre_path(candidates, members, chosen);
    const double length = path_length(path);
    if (length <= (1 - nearly) * kind.length_min || length >= (1 + nearly) * kind.length()) continue;
    if (weakest_link(candidates, members, chosen) > sure) sure_ones.push_back(path);
    whole.push_back(std::move(path));
  }
  TubeShapes of_all(whole, kind.radius, enough);
  if (of_all.are_known()) return of_all;
  TubeShapes of_sure_ones(sure_ones, kind.radius, enough_sure_ones);
  return of_sure_ones.are_bent() ? of_sure_ones : TubeShapes();
}

// The likeliest combination of links.
ChosenLinks likeliest(const Candidates& candidates) {
  std::vector<std::size_t> all(candidates.links.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  Selection::Costs costs;
  const Selection none(candidates, costs);
  Selection selection = none;
  // Matching pairs ends, so it cannot represent a junction of three ends.
  if (!candidates.kind.branches()) selection.take_possible(possible_matching(candidates, none));
  selection.take_possible(all);
  const Selection best = exchanged(candidates, std::move(selection), all);
  ChosenLinks chosen{.links = best.taken(), .log_odds = best.weight()};
  std::ranges::sort(chosen.links);
  return chosen;
}

}  // namespace

ChosenLinks choose_links(const std::vector<Fragment>& fragments, const std::vector<Link>& links,
                         const TubeKind& kind, const LinkSettings& settings, const RangeImage& seen) {
  Candidates candidates{fragments, links, kind, settings, seen};
  add_graph(candidates);
  add_numbers(candidates);
  add_parts(candidates);
  ChosenLinks chosen = likeliest(candidates);
  if (kind.branches()) return chosen;
  candidates.shapes = shapes_of_whole_chains(candidates, chosen.links);
  if (!candidates.shapes.are_known()) return chosen;
  add_parts(candidates);
  return likeliest(candidates);
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
