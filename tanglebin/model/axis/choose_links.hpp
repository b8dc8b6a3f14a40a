#pragma once

#include <cstddef>
#include <vector>

#include "tanglebin/model/axis/fragments.hpp"
#include "tanglebin/model/axis/links.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// Those of find_links() that together are the likeliest, with which every tube is open, no longer than
/// known, and has no more ends than there can be: for chains a matching of greatest weight between the ends,
/// for trees the heaviest links one after the other; then links are exchanged as long as the sum of the
/// weights, for trees less what shapes cost that do not fit the known segments, grows. Indices, ascending.
std::vector<std::size_t> choose_links(const std::vector<Fragment>& fragments, const std::vector<Link>& links,
                                      const TubeKind& kind, const LinkSettings& settings);

/// The fragments of each tube that the chosen links make: each ascending, the tubes by their first.
std::vector<std::vector<std::size_t>> linked_fragments(std::size_t fragments, const std::vector<Link>& links,
                                                       const std::vector<std::size_t>& chosen);

}  // namespace tanglebin
