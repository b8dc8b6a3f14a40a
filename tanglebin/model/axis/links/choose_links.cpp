#include "tanglebin/model/axis/links/choose_links.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

#include "tanglebin/base/picked.hpp"
#include "tanglebin/model/axis/links/link_candidates.hpp"
#include "tanglebin/model/axis/links/matching.hpp"
#include "tanglebin/model/axis/links/selection.hpp"

namespace tanglebin {
namespace {

bool share_an_end(const WeightedPair& a, const WeightedPair& b) {
  const bool same = a.first == b.first || a.second == b.second;
  const bool crossed = a.first == b.second || a.second == b.first;
  return same || crossed;
}

// The links of these fragments whose ends are free if this one is taken.
std::vector<std::size_t> free_links_with(std::size_t link, const std::vector<std::size_t>& fragments,
                                         const Selection& selection, const LinkCandidates& candidates) {
  std::size_t size = 0;
  for (const std::size_t fragment : fragments) size += candidates.links_of[fragment].size();
  std::vector<std::size_t> free(size);
  // Whether a link is free is hard to predict, so this does not branch on it.
  auto end = free.begin();
  for (const std::size_t fragment : fragments) {
    for (const std::size_t other : candidates.links_of[fragment]) {
      const bool is_free = selection.has_free_ends(other);
      const bool is_apart = !share_an_end(candidates.pairs[other], candidates.pairs[link]);
      *end = other;
      end += is_free && is_apart ? 1 : 0;
    }
  }
  free.erase(end, free.end());
  return free;
}

/// Bounds what a selection can weigh.
class Bound {
public:
  explicit Bound(const LinkCandidates& candidates)
      : candidates_(candidates), most_(candidates.vertices), is_given_(candidates.fragments.size()) {}

  // The most that a selection can weigh with some of these links too, each of which has an end on these
  // fragments. An end has one link at most, so each end counts with its heaviest one; of a link between two
  // of the fragments, with a half. What tubes cost now, larger ones need not.
  double most_with(const Selection& selection, const std::vector<std::size_t>& fragments,
                   const std::vector<std::size_t>& links) {
    double sum = selection.weight();
    for (const std::size_t i : fragments) {
      if (selection.represents(i)) sum += selection.cost_of_tube(i);
      is_given_[i] = 1;
    }
    for (const std::size_t i : links) {
      const auto& [from, to, weight] = candidates_.pairs[i];
      const auto& [first, second] = candidates_.fragments_of[i];
      if (is_given_[second] == 0) {
        sum += raise(from, weight + selection.cost_of_tube(second));
      } else if (is_given_[first] == 0) {
        sum += raise(to, weight + selection.cost_of_tube(first));
      } else {
        sum += raise(from, weight / 2);
        sum += raise(to, weight / 2);
      }
    }
    for (const std::size_t i : fragments) is_given_[i] = 0;
    for (const std::size_t i : links)
      most_[candidates_.pairs[i].first] = most_[candidates_.pairs[i].second] = 0;
    return sum;
  }

private:
  // By how much.
  double raise(std::size_t vertex, double weight) {
    const double before = std::exchange(most_[vertex], std::max(weight, most_[vertex]));
    return most_[vertex] - before;
  }

  const LinkCandidates& candidates_;
  // Zeros between two calls.
  std::vector<double> most_;            // of each vertex
  std::vector<std::uint8_t> is_given_;  // for each fragment: 1 if it is
};

// Takes a link, whatever can be kept of the tubes that it joins, and the heaviest of the other links of their
// fragments. A single link rarely repairs a tree made of parts of two, so this also tries to rebuild both
// from nothing. Returns false if that cannot be any better than before.
bool exchange_for(const LinkCandidates& candidates, Selection& selection, std::size_t link, Bound& bound) {
  const double before = selection.weight();
  const Selection::Released released = selection.release_tubes_of(link);
  std::vector<std::size_t> others = free_links_with(link, released.fragments, selection, candidates);
  const double most = bound.most_with(selection, released.fragments, others) + candidates.pairs[link].weight;
  if (most <= before || !selection.take(link)) return false;  // nearly always the former
  std::ranges::sort(others);
  const Selection::Mark with_link = selection.mark();
  const auto take_what_is_possible = [&] {
    selection.take_possible(released.links);
    selection.take_possible(others);
  };
  take_what_is_possible();
  if (!candidates.kind.branches()) return true;
  const double kept = selection.weight();
  selection.undo_to(with_link);
  selection.take_possible(others);
  if (selection.weight() > kept) return true;
  selection.undo_to(with_link);
  take_what_is_possible();
  return true;
}

// The links that are among the heaviest of one of their ends. Others are hardly ever worth an exchange, but
// in a heap of bars they are most of the links.
std::vector<std::size_t> heaviest_at_an_end(const LinkCandidates& candidates,
                                            const std::vector<std::size_t>& links) {
  constexpr int most = 12;
  std::vector<int> heavier(candidates.vertices);
  std::vector<std::size_t> heaviest;
  std::ranges::copy_if(links, std::back_inserter(heaviest), [&](std::size_t i) {
    const int of_first = heavier[candidates.pairs[i].first]++;
    const int of_second = heavier[candidates.pairs[i].second]++;
    return std::min(of_first, of_second) < most;
  });
  return heaviest;
}

// Repeatedly moves to a heavier selection, by exchanging links for each link in turn. There is a limit to the
// tries where there are many links: between thousands of pieces of noise.
void exchange(const LinkCandidates& candidates, Selection& selection, const std::vector<std::size_t>& all) {
  constexpr double rounding = 1e-9;
  constexpr std::size_t looks_max = 20'000'000;
  std::size_t tries_left = looks_max / std::max<std::size_t>(candidates.fragments.size(), 1);
  const std::vector<std::size_t> tried = heaviest_at_an_end(candidates, all);
  std::size_t in_vain = 0;  // links tried since the last exchange
  Bound bound(candidates);
  selection.sum_weight_anew();
  for (std::size_t i = 0; in_vain < tried.size() && tries_left > 0;
       i = (i + 1) % tried.size(), --tries_left) {
    ++in_vain;
    const Selection::Mark before = selection.mark();
    const auto is_heavier = [&] { return selection.weight() > before.weight + rounding; };
    if (exchange_for(candidates, selection, tried[i], bound) && is_heavier()) {
      selection.take_possible(all);
      // Without that, two selections that differ by rounding could follow each other for ever.
      selection.sum_weight_anew();
      if (is_heavier()) {
        in_vain = 0;
        continue;
      }
    }
    selection.undo_to(before);
  }
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
std::vector<std::size_t> possible_matching(const LinkCandidates& candidates, const Selection& none) {
  std::vector<WeightedPair> pairs = candidates.pairs;
  for (;;) {
    std::vector<std::size_t> matching = heaviest_matching(candidates.vertices, pairs);
    const std::vector<std::size_t> impossible = impossible_links(matching, none);
    if (impossible.empty()) return matching;
    for (const std::size_t i : impossible) pairs[i].weight = 0;
  }
}

// What the whole chains among the chosen look like. Without a known length, none is known to be whole.
TubeShapes shapes_of_whole_chains(const LinkCandidates& candidates, const std::vector<std::size_t>& chosen) {
  constexpr double nearly = 0.05;  // of the length
  const TubeKind& kind = candidates.kind;
  if (kind.length_min <= 0) return {};
  std::vector<CentrePath> whole;
  for (const auto& members : linked_fragments(candidates.fragments.size(), candidates.links, chosen)) {
    CentrePath path = centre_path(candidates, members, chosen);
    const double length = path_length(path);
    if (length > (1 - nearly) * kind.length_min && length < (1 + nearly) * kind.length())
      whole.push_back(std::move(path));
  }
  return {whole, kind.radius};
}

// The likeliest combination of links.
ChosenLinks likeliest(const LinkCandidates& candidates) {
  std::vector<std::size_t> all(candidates.links.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  Selection::Costs costs;
  const Selection none(candidates, costs);
  Selection selection = none;
  // Matching pairs ends, so it cannot represent a junction of three ends.
  if (!candidates.kind.branches()) selection.take_possible(possible_matching(candidates, none));
  selection.take_possible(all);
  exchange(candidates, selection, all);
  return {.links = selection.taken(), .log_odds = selection.weight(), .shapes = {}};
}

/// Links with other weights, heaviest first.
struct Reweighed {
  std::vector<Link> links;
  std::vector<std::size_t> before;  ///< for each, its index among those that it comes from
};

Reweighed reweighed_where_bent(std::vector<Link> links, const LinkSettings& settings) {
  for (Link& link : links) link.weight = weight_where_bent(link, settings);
  std::vector<std::size_t> order(links.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return links[i].weight; });
  return {.links = picked(links, order), .before = order};
}

// The likeliest combination of links of chains that look like these.
ChosenLinks likeliest_like(TubeShapes shapes, const LinkCandidates& of, const std::vector<Link>& links) {
  LinkCandidates alike(of.fragments, links, of.kind, of.settings, of.seen, std::move(shapes));
  ChosenLinks chosen = likeliest(alike);
  chosen.shapes = std::move(alike.shapes);
  return chosen;
}

// The same for bent chains.
ChosenLinks likeliest_bent_like(TubeShapes shapes, const LinkCandidates& of, const std::vector<Link>& links) {
  const auto [by_weight, before] = reweighed_where_bent(links, of.settings);
  ChosenLinks chosen = likeliest_like(std::move(shapes), of, by_weight);
  for (std::size_t& link : chosen.links) link = before[link];
  std::ranges::sort(chosen.links);
  return chosen;
}

}  // namespace

ChosenLinks choose_links(const std::vector<Fragment>& fragments, const std::vector<Link>& links,
                         const TubeKind& kind, const LinkSettings& settings, const RangeImage& seen,
                         const TubeShapes& otherwise) {
  const std::vector<Link> likely_links = likely(links);
  const LinkCandidates candidates(fragments, likely_links, kind, settings, seen);
  ChosenLinks chosen = likeliest(candidates);
  if (kind.branches()) return chosen;
  TubeShapes shapes = shapes_of_whole_chains(candidates, chosen.links);
  if (!shapes.are_known()) shapes = otherwise;
  if (!shapes.are_known()) return chosen;
  if (shapes.are_bent()) return likeliest_bent_like(std::move(shapes), candidates, links);
  return likeliest_like(std::move(shapes), candidates, likely_links);
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
