#include "tanglebin/model/axis/links/length.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "tanglebin/model/axis/links/choose_links.hpp"
#include "tanglebin/model/axis/links/links.hpp"

namespace tanglebin {
namespace {

constexpr std::size_t enough = 3;  // chains of a length, to be sure that it is the tubes'
constexpr double far = 2.6;        // times the longest fragment: how long a tube of a few pieces may be

/// A chain of fragments.
struct Chain {
  double length;  ///< m
  bool is_cut;    ///< by the border of the image
};

bool leaves_view(const FragmentEnd& end, double radius, const RangeImage& seen) {
  return !seen.covers(end.position + 2 * radius * end.outward, radius);
}

// The chains that the chosen links make of the fragments.
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
    Chain chain{.length = 0, .is_cut = false};
    for (const std::size_t member : members) {
      const Fragment& fragment = fragments[member];
      chain.length += fragment.length + gaps[member];
      for (std::size_t end = 0; end < fragment.ends.size(); ++end) {
        chain.length += (fragment.ends[end].position - fragment.nodes[fragment.ends[end].node]).norm();
        if (!joined.contains({member, end}) && leaves_view(fragment.ends[end], radius, seen))
          chain.is_cut = true;
      }
    }
    chains.push_back(chain);
  }
  return chains;
}

// Those as long as the kind is, within a few percent. What the image cuts off may be longer.
std::vector<Chain> as_long_as(const TubeKind& kind, std::vector<Chain> chains) {
  constexpr double tolerance = 0.035;
  std::erase_if(chains, [&](const Chain& chain) {
    return chain.is_cut || chain.length < (1 - tolerance) * kind.length_min ||
           chain.length > (1 + tolerance) * kind.length();
  });
  return chains;
}

// The links between fragments that are likely in any tube of the kind, bent or not: at a wrong length, there
// is always a way to bend. Where there are thousands, nearly all are between pieces of noise: the length is
// looked for with the first of them, in bounded time.
std::vector<Link> links_to_try(const std::vector<Fragment>& fragments, const RangeImage& seen,
                               const TubeKind& kind, const LinkSettings& settings) {
  constexpr std::size_t most = 1000;
  std::vector<Link> links = likely(find_links(fragments, seen, kind, settings));
  links.erase(links.begin() + static_cast<std::ptrdiff_t>(std::min(links.size(), most)), links.end());
  return links;
}

// Those that chains of this length, m, can have.
std::vector<Link> possible_links(double length, const std::vector<Fragment>& fragments,
                                 std::vector<Link> links, const LinkSettings& settings) {
  std::erase_if(links, [&](const Link& link) {
    return fragments[link.fragment].length + link.gap + fragments[link.to.fragment].length >
           length_max(length, settings);
  });
  return links;
}

// The lengths of the chains that are alike, ascending: of as many as possible. Two tubes that are taken for
// one are as long as another by chance, but seldom to within a few percent.
std::vector<double> alike_lengths(const std::vector<Chain>& chains) {
  constexpr double alike = 1.03;
  std::vector<double> lengths;
  lengths.reserve(chains.size());
  for (const Chain& chain : chains) lengths.push_back(chain.length);
  std::ranges::sort(lengths);
  std::size_t most = 0;
  std::size_t first_of_most = 0;
  std::size_t first = 0;
  for (std::size_t last = 0; last < lengths.size(); ++last) {
    while (lengths[last] > alike * lengths[first]) ++first;
    if (last + 1 - first <= most) continue;
    most = last + 1 - first;
    first_of_most = first;
  }
  const auto begin = lengths.begin() + static_cast<std::ptrdiff_t>(first_of_most);
  return {begin, begin + static_cast<std::ptrdiff_t>(most)};
}

// The mean would be too short, since ends are hidden; the longest is too long, since there is noise.
double upper_quartile(const std::vector<double>& ascending) {
  return ascending[3 * ascending.size() / 4];
}

/// A length that was tried as though it had been told.
struct Trial {
  double length;       ///< m, of the chains that have it
  double longest;      ///< m, of the longest of them
  std::size_t chains;  ///< that have it
  double evidence;     ///< log odds
  double prior;        ///< log odds, of the links: fragments are parts of tubes more often than tubes
};

// Tries a kind of a known length. `links` are those of longer chains.
Trial trial_of(const TubeKind& kind, const std::vector<Fragment>& fragments, std::vector<Link> links,
               const RangeImage& seen, const LinkSettings& settings) {
  constexpr double of_a_chain = 10;  // evidence for its length
  const double length = kind.length();
  links = possible_links(length, fragments, std::move(links), settings);
  const ChosenLinks chosen = choose_links(fragments, links, kind, settings, seen);
  const std::vector<Chain> chains =
      as_long_as(kind, chains_of(fragments, links, chosen.links, kind.radius, seen));
  const bool is_range = kind.length_min < kind.length();
  const std::vector<double> alike = alike_lengths(chains);
  const auto agreeing = static_cast<double>(is_range ? chains.size() : alike.size());
  const double prior = settings.chain_prior * static_cast<double>(chosen.links.size());
  return {.length = alike.empty() ? length : upper_quartile(alike),
          .longest = chains.empty() ? length : std::ranges::max(chains, {}, &Chain::length).length,
          .chains = chains.size(),
          .evidence = chosen.log_odds - prior + of_a_chain * agreeing,
          .prior = prior};
}

TubeKind of_length(TubeKind kind, double length) {
  kind.segments[0].length = kind.length_min = length;
  return kind;
}

TubeKind of_any_length(TubeKind kind) {
  kind.segments[0].length = std::numeric_limits<double>::infinity();
  kind.length_min = 0;
  return kind;
}

// These lengths, m. At too small a length, true links are missing; at too large a length, chains are seen to
// end before it.
std::vector<Trial> trials_of(const std::vector<double>& lengths, const TubeKind& kind,
                             const std::vector<Fragment>& fragments, const std::vector<Link>& links,
                             const RangeImage& seen, const LinkSettings& settings) {
  std::vector<Trial> trials;
  trials.reserve(lengths.size());
  for (const double length : lengths)
    trials.push_back(trial_of(of_length(kind, length), fragments, links, seen, settings));
  return trials;
}

// Where the lengths to try begin, m. Two tubes that are taken for one may be longer than the tubes are, but
// then they are fewer than it takes to be sure of a length.
double shortest_to_try(const std::vector<Fragment>& fragments, double longest) {
  std::vector<double> lengths;
  lengths.reserve(fragments.size());
  for (const Fragment& fragment : fragments) lengths.push_back(fragment.length);
  const auto last = lengths.begin() + static_cast<std::ptrdiff_t>(std::min(enough, lengths.size()) - 1);
  std::ranges::nth_element(lengths, last, std::greater<>());
  return std::max(*last, longest / far);
}

// The lengths, m, that the tubes may have. Where tubes are torn into many pieces, also those of longer
// chains.
std::vector<double> lengths_to_try(double shortest, double longest, std::vector<Chain> chains) {
  constexpr double step = 1.03;
  std::vector<double> lengths{shortest};
  while (lengths.back() * step < far * longest) lengths.push_back(lengths.back() * step);
  std::ranges::sort(chains, {}, &Chain::length);
  for (const Chain& chain : chains) {
    if (chain.length > step * lengths.back()) lengths.push_back(chain.length);
  }
  return lengths;
}

// For the length that a kind is known to have. A fragment that is longer may be no tube: the rim of a bin.
double evidence_for(const TubeKind& known, const std::vector<Fragment>& fragments,
                    const std::vector<Link>& links, const RangeImage& seen, const LinkSettings& settings) {
  const TubeKind told = known.length_min > 0 ? known : of_length(known, known.length());
  return trial_of(told, fragments, links, seen, settings).evidence;
}

}  // namespace

TubeKind with_length(TubeKind kind, const std::vector<Fragment>& fragments, const RangeImage& seen,
                     const LinkSettings& settings) {
  if (kind.branches() || fragments.empty()) return kind;
  const double longest = std::ranges::max_element(fragments, {}, &Fragment::length)->length;
  const bool is_known = kind.length_is_known();
  if (is_known && longest <= length_max(kind.length(), settings)) return kind;
  const TubeKind any = of_any_length(kind);
  const std::vector<Link> links = links_to_try(fragments, seen, any, settings);
  const ChosenLinks chosen = choose_links(fragments, links, any, settings, seen);
  const std::vector<double> lengths =
      lengths_to_try(shortest_to_try(fragments, longest), longest,
                     chains_of(fragments, links, chosen.links, kind.radius, seen));
  const std::vector<Trial> trials = trials_of(lengths, kind, fragments, links, seen, settings);
  const Trial likeliest = std::ranges::max(trials, {}, &Trial::evidence);
  const bool is_sure = likeliest.chains >= enough;
  if (is_sure && !is_known) return of_length(kind, likeliest.length);
  if (is_known) {
    const bool is_longer = likeliest.longest > kind.length();
    if (is_sure && is_longer && evidence_for(kind, fragments, links, seen, settings) < likeliest.evidence)
      kind.segments[0].length = likeliest.longest;
    return kind;
  }
  // With all of the prior, the largest length wins, and tubes that are not one are joined. Without it, a tube
  // in pieces falls apart that no other is as long as.
  constexpr double share = 0.25;
  const auto evidence = [](const Trial& trial) { return trial.evidence + share * trial.prior; };
  kind.segments[0].length = std::max(std::ranges::max(trials, {}, evidence).longest, longest);
  return kind;
}

}  // namespace tanglebin
