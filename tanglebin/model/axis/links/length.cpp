#include "tanglebin/model/axis/links/length.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>

#include "tanglebin/model/axis/links/choose_links.hpp"
#include "tanglebin/model/axis/links/links.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

// The lengths of the chains of these fragments that are seen from end to end, ascending. m
std::vector<double> lengths_of_whole_chains(const std::vector<Fragment>& fragments,
                                            const std::vector<Link>& links,
                                            const std::vector<std::size_t>& chosen) {
  std::set<std::pair<std::size_t, std::size_t>> joined;
  for (const std::size_t i : chosen) {
    joined.insert({links[i].fragment, links[i].end});
    joined.insert({links[i].to.fragment, *links[i].to.end});
  }
  std::vector<double> gaps(fragments.size());
  for (const std::size_t i : chosen) gaps[links[i].fragment] += links[i].gap;
  std::vector<double> lengths;
  for (const std::vector<std::size_t>& members : linked_fragments(fragments.size(), links, chosen)) {
    double length = 0;
    bool is_whole = true;
    for (const std::size_t member : members) {
      const Fragment& fragment = fragments[member];
      length += fragment.length + gaps[member];
      for (std::size_t end = 0; end < fragment.ends.size(); ++end) {
        length += (fragment.ends[end].position - fragment.nodes[fragment.ends[end].node]).norm();
        if (!joined.contains({member, end}) && fragment.ends[end].hidden > 0) is_whole = false;
      }
    }
    if (is_whole) lengths.push_back(length);
  }
  std::ranges::sort(lengths);
  return lengths;
}

/// A length, and how many chains have it.
struct Agreement {
  double length = 0;  // m
  std::size_t chains = 0;
};

// Of ascending lengths, those within a few percent of each other that have the largest sum; their middle.
Agreement agreement_of(const std::vector<double>& lengths) {
  constexpr double tolerance = 0.05;
  Agreement best;
  double most = 0;
  for (std::size_t first = 0; first < lengths.size(); ++first) {
    double sum = 0;
    std::size_t end = first;
    while (end < lengths.size() && lengths[end] <= lengths[first] * (1 + tolerance)) sum += lengths[end++];
    if (sum <= most) continue;
    most = sum;
    best = {lengths[(first + end) / 2], end - first};
  }
  return best;
}

constexpr double hidden = 1.5;     // the length of a chain, against the longest piece seen
constexpr std::size_t enough = 3;  // chains that agree

/// The chains that are seen from end to end.
struct WholeChains {
  std::vector<double> lengths;  // m, ascending
  Agreement agreement;
};

// Where too few are seen in one piece, links make more of them, without regard to the known length but for
// its maximum.
WholeChains whole_chains(TubeKind kind, const std::vector<Fragment>& fragments, const RangeImage& seen,
                         double longest, const LinkSettings& settings) {
  std::vector<double> lengths = lengths_of_whole_chains(fragments, {}, {});
  const Agreement agreement = agreement_of(lengths);
  if (agreement.chains >= enough && agreement.length * (1 + settings.length_tolerance) >= longest)
    return {std::move(lengths), agreement};
  kind.segments[0].length = std::min(kind.length(), hidden * std::max(longest, agreement.length));
  const std::vector<Link> links = find_links(fragments, seen, kind, settings);
  lengths = lengths_of_whole_chains(fragments, links, choose_links(fragments, links, kind, settings));
  const Agreement of_linked = agreement_of(lengths);
  return {std::move(lengths), of_linked};
}

// A known length, unless it is too short for what is seen.
double checked_length(const TubeKind& kind, const std::vector<Fragment>& fragments, const RangeImage& seen,
                      double longest, const LinkSettings& settings) {
  if (longest <= length_max(kind.length(), settings)) return kind.length();
  TubeKind unknown = kind;
  unknown.segments[0].length = std::numeric_limits<double>::infinity();
  unknown.length_min = 0;
  const Agreement agreement = whole_chains(unknown, fragments, seen, longest, settings).agreement;
  const bool is_too_short =
      agreement.chains >= enough && agreement.length > length_max(kind.length(), settings);
  return is_too_short ? agreement.length : kind.length();
}

double found_length(const TubeKind& kind, const std::vector<Fragment>& fragments, const RangeImage& seen,
                    double longest, const LinkSettings& settings) {
  const auto [lengths, agreement] = whole_chains(kind, fragments, seen, longest, settings);
  if (lengths.empty()) return hidden * longest;
  const bool most_agree = 2 * agreement.chains > lengths.size();
  return std::max(most_agree ? agreement.length : lengths.back(), longest);
}

}  // namespace

TubeKind with_length(TubeKind kind, const std::vector<Fragment>& fragments, const RangeImage& seen,
                     const LinkSettings& settings) {
  if (kind.branches() || fragments.empty()) return kind;
  const double longest = std::ranges::max_element(fragments, {}, &Fragment::length)->length;
  const auto length = kind.length_is_known() ? checked_length : found_length;
  kind.segments[0].length = length(kind, fragments, seen, longest, settings);
  return kind;
}

}  // namespace tanglebin
