#include "tanglebin/model/axis/links/length.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "tanglebin/model/axis/links/choose_links.hpp"
#include "tanglebin/model/axis/links/links.hpp"

namespace tanglebin {
namespace {

/// A chain of fragments.
struct Chain {
  double length;  ///< m
  bool is_whole;  ///< seen from end to end
  bool is_cut;    ///< by the border of the image
};

bool leaves_view(const FragmentEnd& end, double radius, const RangeImage& seen) {
  return !seen.covers(end.position + 2 * radius * end.outward, radius);
}

// The chains that the chosen links make of the fragments, the shortest first.
std::vector<Chain> chains_of(const std::vector<Fragment>& fragments, const std::vector<Link>& links,
                             const std::vector<std::size_t>& chosen, double radius, const RangeImage& seen) {
  std::set<std::pair<std::size_t, std::size_t>> joined;
  for (const std::size_t i : chosen) {
    joined.insert({links[i].fragment, links[i].end});
    joined.insert({links[i].to.fragment, *links[i].to.end});
  }
  std::vector<double> gaps(fragments.size());
  for (const std::size_t i : chosen) gaps[links[i].fragment] += links[i].gap;
  std::vector<Chain> chains;
  for (const std::vector<std::size_t>& members : linked_fragments(fragments.size(), links, chosen)) {
    Chain chain{.length = 0, .is_whole = true, .is_cut = false};
    for (const std::size_t member : members) {
      const Fragment& fragment = fragments[member];
      chain.length += fragment.length + gaps[member];
      for (std::size_t end = 0; end < fragment.ends.size(); ++end) {
        chain.length += (fragment.ends[end].position - fragment.nodes[fragment.ends[end].node]).norm();
        if (joined.contains({member, end})) continue;
        if (fragment.ends[end].hidden > 0) chain.is_whole = false;
        if (leaves_view(fragment.ends[end], radius, seen)) chain.is_cut = true;
      }
    }
    chains.push_back(chain);
  }
  std::ranges::sort(chains, {}, &Chain::length);
  return chains;
}

// Those of the likeliest links, if no chain is longer than this, m.
std::vector<Chain> chains_up_to(double longest, TubeKind kind, const std::vector<Fragment>& fragments,
                                const RangeImage& seen, const LinkSettings& settings) {
  kind.segments[0].length = longest;
  const std::vector<Link> links = find_links(fragments, seen, kind, settings);
  return chains_of(fragments, links, choose_links(fragments, links, kind, settings), kind.radius, seen);
}

std::vector<Chain> whole(std::vector<Chain> chains) {
  std::erase_if(chains, [](const Chain& chain) { return !chain.is_whole; });
  return chains;
}

std::vector<Chain> uncut(std::vector<Chain> chains) {
  std::erase_if(chains, &Chain::is_cut);
  return chains;
}

double sum_of_lengths(std::span<const Chain> chains) {
  return std::accumulate(chains.begin(), chains.end(), 0.0,
                         [](double sum, const Chain& chain) { return sum + chain.length; });
}

// Of chains in ascending order, those within a few percent of each other that have the largest sum.
std::span<const Chain> of_one_length(std::span<const Chain> chains) {
  constexpr double tolerance = 0.05;
  std::span<const Chain> best;
  double most = 0;
  for (std::size_t first = 0; first < chains.size(); ++first) {
    const auto end =
        std::ranges::upper_bound(chains, chains[first].length * (1 + tolerance), {}, &Chain::length);
    const std::span<const Chain> alike(chains.begin() + static_cast<std::ptrdiff_t>(first), end);
    const double sum = sum_of_lengths(alike);
    if (sum <= most) continue;
    best = alike;
    most = sum;
  }
  return best;
}

/// The length that many of a scan's chains have.
struct CommonLength {
  double length;  ///< m
  bool is_sure;   ///< so many have it that it may be used like one that was told
};

constexpr std::size_t enough = 3;  // chains that agree

// That of the fragments which are whole chains, if enough agree.
std::optional<CommonLength> length_of_pieces(const std::vector<Fragment>& fragments, double radius,
                                             const RangeImage& seen, double longest,
                                             const LinkSettings& settings) {
  const std::vector<Chain> pieces = whole(chains_of(fragments, {}, {}, radius, seen));
  const std::span<const Chain> alike = of_one_length(pieces);
  if (alike.size() < enough || length_max(alike.back().length, settings) < longest) return std::nullopt;
  return CommonLength{alike[alike.size() / 2].length, true};
}

// That of linked chains: too low a bound breaks them at it, and at lengths that differ; any other leaves
// those that most links make at theirs.
std::optional<CommonLength> length_of_linked(const TubeKind& kind, const std::vector<Fragment>& fragments,
                                             const RangeImage& seen, double longest,
                                             const LinkSettings& settings) {
  constexpr std::array bounds = {1.25, 1.6, 2.05, 2.6};  // against the longest fragment
  constexpr double at_bound = 0.97;
  constexpr double few = 0.2;  // of the length of all chains
  constexpr double many = 0.3;
  constexpr double nearly_all = 0.8;
  constexpr double most = 0.5;
  std::optional<CommonLength> common;
  double best_share = 0;
  for (const double bound : bounds) {
    const std::vector<Chain> chains = chains_up_to(bound * longest, kind, fragments, seen, settings);
    const std::vector<Chain> may_be_whole = uncut(chains);
    const std::span<const Chain> alike = of_one_length(may_be_whole);
    const double all = sum_of_lengths(chains);
    const double share = sum_of_lengths(alike) / all;
    const bool are_enough = alike.size() >= enough;
    const bool few_will_do = are_enough && sum_of_lengths(may_be_whole) > nearly_all * all;
    if (alike.empty() || share < best_share || alike.back().length > at_bound * bound * longest) continue;
    if (share < (few_will_do ? few : many)) continue;
    common = {alike.back().length, are_enough && share >= many};
    best_share = share;
    if (share > most) break;
  }
  return common;
}

std::optional<CommonLength> common_length(const TubeKind& kind, const std::vector<Fragment>& fragments,
                                          const RangeImage& seen, double longest,
                                          const LinkSettings& settings) {
  const auto of_pieces = length_of_pieces(fragments, kind.radius, seen, longest, settings);
  return of_pieces ? of_pieces : length_of_linked(kind, fragments, seen, longest, settings);
}

// A known length, unless it is too short for what is seen.
TubeKind with_checked_length(TubeKind kind, const std::vector<Fragment>& fragments, const RangeImage& seen,
                             double longest, const LinkSettings& settings) {
  if (longest <= length_max(kind.length(), settings)) return kind;
  TubeKind unknown = kind;
  unknown.length_min = 0;
  const auto common = common_length(unknown, fragments, seen, longest, settings);
  if (common && common->is_sure && common->length > length_max(kind.length(), settings))
    kind.segments[0].length = common->length;
  return kind;
}

TubeKind with_found_length(TubeKind kind, const std::vector<Fragment>& fragments, const RangeImage& seen,
                           double longest, const LinkSettings& settings) {
  constexpr double hidden = 2;  // the length of a chain, against the longest fragment
  if (const auto common = common_length(kind, fragments, seen, longest, settings)) {
    kind.segments[0].length = std::max(common->length, longest);
    if (common->is_sure) kind.length_min = kind.segments[0].length;
    return kind;
  }
  const std::vector<Chain> seen_whole =
      whole(chains_up_to(hidden * longest, kind, fragments, seen, settings));
  kind.segments[0].length =
      seen_whole.empty() ? hidden * longest : std::max(seen_whole.back().length, longest);
  return kind;
}

}  // namespace

TubeKind with_length(TubeKind kind, const std::vector<Fragment>& fragments, const RangeImage& seen,
                     const LinkSettings& settings) {
  if (kind.branches() || fragments.empty()) return kind;
  const double longest = std::ranges::max_element(fragments, {}, &Fragment::length)->length;
  const auto with = kind.length_is_known() ? with_checked_length : with_found_length;
  return with(std::move(kind), fragments, seen, longest, settings);
}

}  // namespace tanglebin
