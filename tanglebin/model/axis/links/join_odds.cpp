#include "tanglebin/model/axis/links/join_odds.hpp"

#include <algorithm>
#include <array>

#include "tanglebin/base/constants.hpp"

namespace tanglebin {
namespace {

/// The links at each end of the fragments. Ends are numbered through all fragments.
class LinksAtEnds {
public:
  LinksAtEnds(const std::vector<Fragment>& fragments, const std::vector<Link>& links,
              const std::vector<std::size_t>& chosen)
      : fragments_(fragments),
        links_(links),
        is_chosen_(links.size(), false),
        of_fragment_(fragments.size()) {
    std::size_t ends = 0;
    for (const Fragment& fragment : fragments) {
      first_end_.push_back(ends);
      ends += fragment.ends.size();
    }
    at_end_.resize(ends);
    chosen_at_end_.resize(ends, no_index);
    for (std::size_t i = 0; i < links.size(); ++i) {
      for (const std::size_t end : ends_of(i)) at_end_[end].push_back(i);
    }
    for (const std::size_t i : chosen) {
      is_chosen_[i] = true;
      for (const std::size_t end : ends_of(i)) chosen_at_end_[end] = i;
      of_fragment_[links[i].fragment].push_back(i);
      of_fragment_[links[i].to.fragment].push_back(i);
    }
  }

  // The least loss of weight in giving up a chosen link.
  double margin_of(std::size_t link, double length_max) const {
    double least = links_[link].weight;
    for (const std::size_t end : ends_of(link)) {
      for (const std::size_t other : at_end_[end]) {
        if (is_chosen_[other]) continue;
        const Exchange exchange = exchange_of(link, end, other);
        if (exchange.loss < least && is_possible(exchange, length_max)) least = exchange.loss;
      }
    }
    return least;
  }

private:
  /// One link instead of another, and what follows from it.
  struct Exchange {
    std::array<std::size_t, 2> dropped;  ///< links; the second may be missing
    std::array<std::size_t, 2> added;    ///< the same
    double loss;                         ///< of weight
  };

  std::vector<std::size_t> ends_of(std::size_t link) const {
    const Link& of = links_[link];
    std::vector<std::size_t> ends{first_end_[of.fragment] + of.end};
    if (ends_taken(of.kind) == 2) ends.push_back(first_end_[of.to.fragment] + *of.to.end);
    return ends;
  }

  std::size_t other_end(std::size_t link, std::size_t end) const {
    for (const std::size_t other : ends_of(link)) {
      if (other != end) return other;
    }
    return no_index;
  }

  double weight_of(std::size_t link) const { return link == no_index ? 0 : links_[link].weight; }

  // Takes `other` at this end instead of `link`. What `other` displaces at its far end is dropped, too, and
  // the two ends that this leaves are linked if they can be.
  Exchange exchange_of(std::size_t link, std::size_t end, std::size_t other) const {
    const std::size_t far_end = other_end(other, end);
    const std::size_t displaced = far_end == no_index ? no_index : chosen_at_end_[far_end];
    const std::size_t left = other_end(link, end);
    const std::size_t also_left = displaced == no_index ? no_index : other_end(displaced, far_end);
    const std::size_t closing =
        left == no_index || also_left == no_index ? no_index : link_between(left, also_left);
    return {{link, displaced},
            {other, closing},
            weight_of(link) + weight_of(displaced) - weight_of(other) - weight_of(closing)};
  }

  std::size_t link_between(std::size_t end, std::size_t other) const {
    for (const std::size_t link : at_end_[end]) {
      if (other_end(link, end) == other) return link;
    }
    return no_index;
  }

  bool is_possible(const Exchange& exchange, double length_max) const {
    return std::ranges::all_of(exchange.added, [&](std::size_t link) {
      return link == no_index || is_possible(link, exchange, length_max);
    });
  }

  // Whether an added link makes a tube that is open and not too long.
  bool is_possible(std::size_t link, const Exchange& exchange, double length_max) const {
    const auto& [kind, from, end, to, gap, features, weight] = links_[link];
    std::vector<std::size_t> seen;
    const double first = length_from(from, exchange, seen);
    if (std::ranges::find(seen, to.fragment) != seen.end()) return false;
    return first + gap + length_from(to.fragment, exchange, seen) <= length_max;
  }

  // The length of what the chosen links, without the dropped ones, join to a fragment.
  double length_from(std::size_t fragment, const Exchange& exchange, std::vector<std::size_t>& seen) const {
    seen.push_back(fragment);
    double length = fragments_[fragment].length;
    for (const std::size_t i : of_fragment_[fragment]) {
      if (std::ranges::find(exchange.dropped, i) != exchange.dropped.end()) continue;
      const std::size_t next = links_[i].fragment == fragment ? links_[i].to.fragment : links_[i].fragment;
      if (std::ranges::find(seen, next) != seen.end()) continue;
      length += links_[i].gap + length_from(next, exchange, seen);
    }
    return length;
  }

  const std::vector<Fragment>& fragments_;
  const std::vector<Link>& links_;
  std::vector<bool> is_chosen_;
  std::vector<std::size_t> first_end_;  // of each fragment
  std::vector<std::vector<std::size_t>> at_end_;
  std::vector<std::size_t> chosen_at_end_;
  std::vector<std::vector<std::size_t>> of_fragment_;  // the chosen links of each
};

}  // namespace

std::vector<TubeJoin> joins_of(const std::vector<Fragment>& fragments, const std::vector<Link>& links,
                               const std::vector<std::size_t>& chosen, double length_max) {
  const LinksAtEnds at_ends(fragments, links, chosen);
  std::vector<TubeJoin> joins;
  for (const std::size_t i : chosen) {
    const Link& link = links[i];
    joins.push_back({fragments[link.fragment].ends[link.end].position, link.to.position, link.weight,
                     at_ends.margin_of(i, length_max)});
  }
  return joins;
}

}  // namespace tanglebin
