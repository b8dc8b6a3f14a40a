#include "tanglebin/model/choose_links.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

#include "tanglebin/model/matching.hpp"

namespace tanglebin {
namespace {

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
  const std::vector<Link>& links;          ///< the heaviest first
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

  /// Takes a link whose ends are free where that makes possible tubes, and says whether it does.
  bool take(std::size_t link) {
    if (!tubes_.allow(candidates_->links[link])) return false;
    tubes_.join(candidates_->links[link]);
    const auto& [first, second, weight] = candidates_->pairs[link];
    used_[first] = used_[second] = 1;
    weight_ += weight;
    taken_.push_back(link);
    return true;
  }

  /// Takes these links, one after the other, where that is possible.
  void take_possible(const std::vector<std::size_t>& links) {
    for (const std::size_t link : links) {
      if (has_free_ends(link)) take(link);  // most have not
    }
  }

  const std::vector<std::size_t>& taken() const { return taken_; }
  double weight() const { return weight_; }

private:
  bool has_free_ends(std::size_t link) const {
    const WeightedPair& pair = candidates_->pairs[link];
    return (used_[pair.first] | used_[pair.second]) == 0;
  }

  const Candidates* candidates_;
  Tubes tubes_;
  std::vector<std::uint8_t> used_;  // whether a vertex is: bytes are quicker to read than bits
  std::vector<std::size_t> taken_;
  double weight_ = 0;
};

// Goes on to a heavier selection as long as there is one that has a certain link, what can be kept beside
// that, and the heaviest of the others.
Selection exchanged(Selection best, const std::vector<std::size_t>& all, const Candidates& candidates) {
  constexpr double rounding = 1e-9;
  const Selection none(candidates);
  std::size_t in_vain = 0;  // links tried since the last exchange
  for (std::size_t i = 0; in_vain < all.size(); i = (i + 1) % all.size()) {
    Selection other = none;
    other.take(i);
    other.take_possible(best.taken());
    other.take_possible(all);
    const bool is_better = other.weight() > best.weight() + rounding;
    if (is_better) best = std::move(other);
    in_vain = is_better ? 0 : in_vain + 1;
  }
  return best;
}

// The links that make one of the tubes impossible: of each such tube the weakest.
std::vector<std::size_t> impossible_links(const std::vector<std::size_t>& matching,
                                          const Candidates& candidates) {
  Selection possible(candidates);
  std::vector<std::size_t> impossible;
  for (const std::size_t i : matching) {
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

}  // namespace

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
    pairs.push_back({from, to, link.weight});
  }
  const Candidates candidates{fragments, links, pairs, 2 * ends, kind, settings};
  std::vector<std::size_t> all(links.size());
  std::iota(all.begin(), all.end(), std::size_t{0});

  Selection selection(candidates);
  // Three ends meet at a junction: a matching, which pairs them, finds chains only.
  if (kind.junctions == 0) selection.take_possible(possible_matching(candidates));
  selection.take_possible(all);
  std::vector<std::size_t> chosen = exchanged(std::move(selection), all, candidates).taken();
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
