#include "tanglebin/model/axis/links/link_candidates.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include "tanglebin/model/axis/links/assemble.hpp"
#include "tanglebin/model/axis/links/beyond_ends.hpp"
#include "tanglebin/model/axis/links/line_tree.hpp"

namespace tanglebin {
namespace {

// The cost of looking unlike the whole chains of the scan.
double cost_of_looks(const LinkCandidates& candidates, const CentrePath& chain) {
  constexpr double cost_max = 20;
  const double ordinary = candidates.settings.strangeness_max;
  const double strangeness = candidates.shapes.strangeness(chain, ordinary) - ordinary;
  return std::clamp(candidates.settings.strangeness_weight * strangeness, 0.0, cost_max);
}

// The cost of looking unlike the whole, bent chains of the scan, and of what was seen to be empty where the
// rest of such a chain must be. Of all ways to lay a whole chain on this one, the one that costs least
// counts.
double cost_of_bent(const LinkCandidates& candidates, const CentrePath& chain) {
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
double cost_of_tree(const LinkCandidates& candidates, const std::vector<std::size_t>& fragments,
                    const std::vector<std::size_t>& chosen) {
  const TubeKind& kind = candidates.kind;
  const SegmentTree seen =
      segments_of(assembled_line(candidates.fragments, fragments, candidates.links, chosen, kind.radius));
  const double length = total_length(seen);
  const double missing = std::min(length, std::max(0.0, kind.length() - length));
  return misfit(seen, kind.segments) / (candidates.settings.misfit_unit * kind.radius) +
         missing / (candidates.settings.missing_unit * kind.radius);
}

void add_graph(LinkCandidates& candidates) {
  std::vector<std::size_t>& ends_before = candidates.ends_before;
  ends_before = {0};
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
    candidates.fragments_of.emplace_back(link.fragment, link.to.fragment);
  }
}

void add_numbers(LinkCandidates& candidates) {
  std::mt19937_64 random;
  for (std::size_t i = 0; i < candidates.links.size(); ++i) candidates.numbers.push_back(random());
}

void add_parts(LinkCandidates& candidates) {
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

}  // namespace

LinkCandidates::LinkCandidates(const std::vector<Fragment>& fragments, const std::vector<Link>& links,
                               const TubeKind& kind, const LinkSettings& settings, const RangeImage& seen,
                               TubeShapes shapes)
    : fragments(fragments),
      links(links),
      kind(kind),
      settings(settings),
      seen(seen),
      tube_length_max(length_max(kind.length(), settings)),
      tube_ends_max(count_ends(kind.segments) + settings.ends_tolerance),
      shapes(std::move(shapes)) {
  add_graph(*this);
  add_numbers(*this);
  add_parts(*this);
}

// It may have been misjudged that an end is free, so the cost has a limit. What trees and bent chains lack is
// a part of the cost of their shape.
double cost_of_length(const LinkCandidates& candidates, const Part& chain) {
  constexpr double cost_max = 10;
  if (candidates.kind.branches() || candidates.shapes.are_bent()) return 0;
  const double unseen = unseen_length(chain.length, chain.hidden, candidates.kind, candidates.settings);
  return std::clamp(unseen / (candidates.settings.unseen_unit * candidates.kind.radius), 0.0, cost_max);
}

bool has_shape_costs(const LinkCandidates& candidates) {
  return candidates.kind.branches() || candidates.shapes.are_known();
}

double shape_cost(const LinkCandidates& candidates, const std::vector<std::size_t>& fragments,
                  const std::vector<std::size_t>& chosen) {
  if (candidates.kind.branches()) return cost_of_tree(candidates, fragments, chosen);
  const CentrePath chain = centre_path(candidates, fragments, chosen);
  return candidates.shapes.are_bent() ? cost_of_bent(candidates, chain) : cost_of_looks(candidates, chain);
}

CentrePath centre_path(const LinkCandidates& candidates, const std::vector<std::size_t>& fragments,
                       const std::vector<std::size_t>& chosen) {
  const LineTree line =
      assembled_line(candidates.fragments, fragments, candidates.links, chosen, candidates.kind.radius);
  const Paths paths(line);
  CentrePath path;
  for (const std::size_t node : paths.all().front()) path.push_back(line.nodes[node]);
  return path;
}

}  // namespace tanglebin
