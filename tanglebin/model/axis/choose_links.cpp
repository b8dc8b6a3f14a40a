#include "tanglebin/model/axis/choose_links.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cstdint>
#include <iterator>
#include <map>
#include <numeric>
#include <random>
#include <unordered_map>
#include <utility>

#include "tanglebin/model/axis/assemble.hpp"
#include "tanglebin/model/axis/matching.hpp"

namespace tanglebin {
namespace {

/// A part of a tube: a fragment, or several with the links between them.
struct Part {
  double length;  ///< m
  int ends;
  std::uint64_t links;  ///< the sum of their numbers
  double cost;          ///< by which its shape makes it less likely, as a logarithm of odds; 0 for chains
};

/// What can be chosen from.
struct Candidates {
  const std::vector<Fragment>& fragments;
  const std::vector<Link>& links;  ///< the heaviest first
  const TubeKind& kind;
  const LinkSettings& settings;
  double tube_length_max = length_max(kind, settings);  ///< m
  int tube_ends_max = count_ends(kind.segments) + settings.ends_tolerance;
  std::vector<WeightedPair> pairs = {};  ///< a link's two ends as vertices, and its weight
  std::size_t vertices = 0;
  std::vector<std::uint64_t> numbers = {};  ///< of links, random: no two sets of links have one sum
  std::vector<Part> alone = {};             ///< the fragments
};

// Of these fragments with the chosen links between them, a part of a tree. One that lacks much of its tree is
// one of which much is hidden or, where that is less, none at all.
double shape_cost(const Candidates& candidates, const std::vector<std::size_t>& fragments,
                  const std::vector<std::size_t>& chosen) {
  const TubeKind& kind = candidates.kind;
  const SegmentTree seen =
      segments_of(assembled_line(candidates.fragments, fragments, candidates.links, chosen, kind.radius));
  const double length = total_length(seen);
  const double missing = std::min(length, std::max(0.0, kind.length() - length));
  return misfit(seen, kind.segments) / (candidates.settings.misfit_unit * kind.radius) +
         missing / (candidates.settings.missing_unit * kind.radius);
}

/// Links of which no two share an end, and that together make possible tubes only.
class Selection {
public:
  /// Shape costs by Part::links, of what was weighed before.
  using Costs = std::unordered_map<std::uint64_t, double>;

  Selection(const Candidates& candidates, Costs& costs)
      : candidates_(&candidates),
        costs_(&costs),
        tubes_(candidates.fragments.size()),
        parts_(candidates.alone),
        used_(candidates.vertices) {}

  /// Takes a link whose ends are free where the tube that it makes is possible, and likelier than its two
  /// parts, and says whether it does.
  bool take(std::size_t link) {
    const std::size_t first = tubes_.find_set(candidates_->links[link].fragment);
    const std::size_t second = tubes_.find_set(candidates_->links[link].to.fragment);
    if (first == second) return false;
    Part tube = joined(first, second, link);
    if (tube.length > candidates_->tube_length_max || tube.ends > candidates_->tube_ends_max) return false;
    if (candidates_->kind.branches()) tube.cost = cost_of(tube, first, second, link);
    const auto& [from, to, weight] = candidates_->pairs[link];
    const double gain = weight + parts_[first].cost + parts_[second].cost - tube.cost;
    if (gain <= 0) return false;
    tubes_.union_set(first, second);
    parts_[tubes_.find_set(first)] = tube;
    used_[from] = used_[to] = 1;
    weight_ += gain;
    taken_.push_back(link);
    return true;
  }

  /// Takes these links, one after the other, where that is possible.
  void take_possible(const std::vector<std::size_t>& links) {
    for (const std::size_t link : links) {
      if (has_free_ends(link)) take(link);  // most have not
    }
  }

  /// Of some of the taken links, those that are not in the tubes that another one would join.
  std::vector<std::size_t> without_tubes_of(std::size_t link, const std::vector<std::size_t>& taken) {
    const std::size_t first = tubes_.find_set(candidates_->links[link].fragment);
    const std::size_t second = tubes_.find_set(candidates_->links[link].to.fragment);
    std::vector<std::size_t> others;
    std::ranges::copy_if(taken, std::back_inserter(others), [&](std::size_t i) {
      const std::size_t tube = tubes_.find_set(candidates_->links[i].fragment);
      return tube != first && tube != second;
    });
    return others;
  }

  const std::vector<std::size_t>& taken() const { return taken_; }
  /// Of the links together, less what shapes cost.
  double weight() const { return weight_; }

private:
  bool has_free_ends(std::size_t link) const {
    const WeightedPair& pair = candidates_->pairs[link];
    return (used_[pair.first] | used_[pair.second]) == 0;
  }

  Part joined(std::size_t first, std::size_t second, std::size_t link) const {
    const Part& a = parts_[first];
    const Part& b = parts_[second];
    const auto& [kind, fragment, end, to, gap, features, weight] = candidates_->links[link];
    return {a.length + gap + b.length, a.ends + b.ends - ends_taken(kind),
            a.links + b.links + candidates_->numbers[link], 0};
  }

  double cost_of(const Part& tube, std::size_t first, std::size_t second, std::size_t link) {
    const auto weighed = costs_->find(tube.links);
    if (weighed != costs_->end()) return weighed->second;
    std::vector<std::size_t> fragments;
    for (std::size_t i = 0; i < candidates_->fragments.size(); ++i) {
      const std::size_t part = tubes_.find_set(i);
      if (part == first || part == second) fragments.push_back(i);
    }
    std::vector<std::size_t> chosen = taken_;
    chosen.push_back(link);
    std::ranges::sort(chosen);
    return (*costs_)[tube.links] = shape_cost(*candidates_, fragments, chosen);
  }

  const Candidates* candidates_;
  Costs* costs_;
  boost::disjoint_sets_with_storage<> tubes_;
  std::vector<Part> parts_;         // the one that a set stands for
  std::vector<std::uint8_t> used_;  // whether a vertex is: bytes are quicker to read than bits
  std::vector<std::size_t> taken_;
  double weight_ = 0;
};

// With what can be kept, and the heaviest of the others.
Selection completed(Selection selection, const std::vector<std::size_t>& kept,
                    const std::vector<std::size_t>& all) {
  selection.take_possible(kept);
  selection.take_possible(all);
  return selection;
}

// Goes on to a heavier selection as long as there is one that has a certain link, what can be kept beside
// that, and the heaviest of the others. One link alone rarely mends a tree that is made of two trees' parts:
// there the two tubes that it joins are also tried anew.
Selection exchanged(const Selection& none, Selection best, const std::vector<std::size_t>& all,
                    bool with_branches) {
  constexpr double rounding = 1e-9;
  const auto heaviest_first = [](std::vector<std::size_t> links) {
    std::ranges::sort(links);
    return links;
  };
  std::vector<std::size_t> kept = heaviest_first(best.taken());
  std::size_t in_vain = 0;  // links tried since the last exchange
  for (std::size_t i = 0; in_vain < all.size(); i = (i + 1) % all.size()) {
    ++in_vain;
    Selection with_link = none;
    if (!with_link.take(i)) continue;
    Selection other = completed(with_link, kept, all);
    if (with_branches) {
      Selection anew = completed(with_link, best.without_tubes_of(i, kept), all);
      if (anew.weight() > other.weight()) other = std::move(anew);
    }
    if (other.weight() <= best.weight() + rounding) continue;
    best = std::move(other);
    kept = heaviest_first(best.taken());
    in_vain = 0;
  }
  return best;
}

// The links that make one of the tubes impossible: of each such tube the weakest.
std::vector<std::size_t> impossible_links(const std::vector<std::size_t>& matching, Selection possible) {
  std::vector<std::size_t> impossible;
  for (const std::size_t i : matching) {
    if (!possible.take(i)) impossible.push_back(i);
  }
  return impossible;
}

// A matching of greatest weight between the ends in which every tube is possible: what makes one impossible
// is given up, and the rest matched again.
std::vector<std::size_t> possible_matching(const Candidates& candidates, const Selection& none) {
  std::vector<WeightedPair> pairs = candidates.pairs;
  for (;;) {
    std::vector<std::size_t> matching = heaviest_matching(candidates.vertices, pairs);
    const std::vector<std::size_t> impossible = impossible_links(matching, none);
    if (impossible.empty()) return matching;
    for (const std::size_t i : impossible) pairs[i].weight = 0;
  }
}

// The graph has a vertex for each end, and one more that stands for the junction that the end may lead to.
void add_graph(Candidates& candidates) {
  std::vector<std::size_t> ends_before{0};
  for (const Fragment& fragment : candidates.fragments)
    ends_before.push_back(ends_before.back() + fragment.ends.size());
  const std::size_t ends = ends_before.back();
  candidates.vertices = 2 * ends;
  candidates.pairs.reserve(candidates.links.size());
  for (const Link& link : candidates.links) {
    const std::size_t from = ends_before[link.fragment] + link.end;
    const bool leads_to_junction = link.kind == LinkKind::junction;
    const std::size_t to = leads_to_junction ? ends + from : ends_before[link.to.fragment] + *link.to.end;
    candidates.pairs.push_back({from, to, link.weight});
  }
}

void add_parts(Candidates& candidates) {
  std::mt19937_64 random;
  for (std::size_t i = 0; i < candidates.links.size(); ++i) candidates.numbers.push_back(random());
  for (std::size_t i = 0; i < candidates.fragments.size(); ++i) {
    const Fragment& fragment = candidates.fragments[i];
    const int ends = static_cast<int>(fragment.ends.size());
    // What has too many ends is in no tube but its own, whatever that costs.
    const bool is_weighed = candidates.kind.branches() && ends <= candidates.tube_ends_max;
    candidates.alone.push_back({fragment.length, ends, 0, is_weighed ? shape_cost(candidates, {i}, {}) : 0});
  }
}

}  // namespace

std::vector<std::size_t> choose_links(const std::vector<Fragment>& fragments, const std::vector<Link>& links,
                                      const TubeKind& kind, const LinkSettings& settings) {
  Candidates candidates{fragments, links, kind, settings};
  add_graph(candidates);
  add_parts(candidates);
  std::vector<std::size_t> all(links.size());
  std::iota(all.begin(), all.end(), std::size_t{0});

  Selection::Costs costs;
  const Selection none(candidates, costs);
  Selection selection = none;
  // Three ends meet at a junction: a matching, which pairs them, finds chains only.
  if (!kind.branches()) selection.take_possible(possible_matching(candidates, none));
  selection.take_possible(all);
  std::vector<std::size_t> chosen = exchanged(none, std::move(selection), all, kind.branches()).taken();
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
