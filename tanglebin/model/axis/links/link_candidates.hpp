#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/links/links.hpp"
#include "tanglebin/model/axis/links/matching.hpp"
#include "tanglebin/model/axis/links/tube_shapes.hpp"
#include "tanglebin/model/axis/settings/axis_settings.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/range_image.hpp"

// Internal to the room.
namespace tanglebin {

/// A part of a tube: one fragment, or several with the links between them.
struct Part {
  double length;  ///< m
  int ends;
  std::uint64_t links;  ///< sum of the random numbers of its links
  double hidden;        ///< m, how far it may go on unseen beyond its ends
  double cost;          ///< of its shape, in log odds
};

/// The links that choose_links() chooses from, as a graph: it has a vertex for each end of a fragment, and
/// one for the junction that each end may lead to.
struct LinkCandidates {
  /// If shapes are known, chains have costs for looking unlike them.
  LinkCandidates(const std::vector<Fragment>& fragments, const std::vector<Link>& links, const TubeKind& kind,
                 const LinkSettings& settings, const RangeImage& seen, TubeShapes shapes = {});

  const std::vector<Fragment>& fragments;
  const std::vector<Link>& links;  ///< heaviest first
  const TubeKind& kind;
  const LinkSettings& settings;
  const RangeImage& seen;
  double tube_length_max;  ///< m
  int tube_ends_max;
  std::vector<WeightedPair> pairs;  ///< the two ends of each link as vertices, and its weight
  std::size_t vertices = 0;
  std::vector<std::size_t> ends_before;  ///< for each fragment, its first vertex; and the number of ends
  std::vector<std::pair<std::size_t, std::size_t>> fragments_of;  ///< for each link, those that it joins
  std::vector<std::vector<std::size_t>> links_of;  ///< for each fragment, those that have an end there
  std::vector<std::uint64_t> numbers;  ///< random, one per link; no two sets of links have the same sum
  std::vector<Part> alone;             ///< each fragment by itself
  TubeShapes shapes;                   ///< what chains look like
};

/// The cost of what a part of a chain lacks, more than can be hidden beyond its ends.
double cost_of_length(const LinkCandidates& candidates, const Part& chain);

/// Whether parts have shape costs.
bool has_shape_costs(const LinkCandidates& candidates);

/// The shape cost of a part, in log odds: these fragments (ascending) with the chosen links between them
/// (ascending).
double shape_cost(const LinkCandidates& candidates, const std::vector<std::size_t>& fragments,
                  const std::vector<std::size_t>& chosen);

/// The centre line of a chain: these fragments with the chosen links between them.
CentrePath centre_path(const LinkCandidates& candidates, const std::vector<std::size_t>& fragments,
                       const std::vector<std::size_t>& chosen);

}  // namespace tanglebin
