#pragma once

#include <cstddef>
#include <vector>

#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/links/links.hpp"
#include "tanglebin/model/axis/links/tube_shapes.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/range_image.hpp"

namespace tanglebin {

/// Links that are chosen together.
struct ChosenLinks {
  std::vector<std::size_t> links;  ///< ascending
  double log_odds;                 ///< the sum of their weights, less the costs of the tubes' shapes
  TubeShapes shapes;               ///< of whole chains that they were chosen by, if any are known
};

/// Chooses the likeliest combination of the links from find_links() in which every tube is open, no longer
/// than known, and has no surplus ends. For chains this is the maximum-weight matching of the ends, for trees
/// the heaviest links one after the other. Then links are exchanged while that increases their log odds.
/// Where whole chains are alike, links are chosen again by what they look like; and if these are bent, also
/// by what is seen where the rest of a chain must be. `otherwise` is what whole chains look like if those
/// that are found do not show it.
ChosenLinks choose_links(const std::vector<Fragment>& fragments, const std::vector<Link>& links,
                         const TubeKind& kind, const LinkSettings& settings, const RangeImage& seen,
                         const TubeShapes& otherwise = {});

/// The fragments of each tube that the chosen links form. Each list is ascending; the tubes are sorted by
/// their first fragment.
std::vector<std::vector<std::size_t>> linked_fragments(std::size_t fragments, const std::vector<Link>& links,
                                                       const std::vector<std::size_t>& chosen);

}  // namespace tanglebin
