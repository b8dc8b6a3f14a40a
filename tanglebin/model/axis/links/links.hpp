#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/links/obstacles.hpp"
#include "tanglebin/model/axis/settings/axis_settings.hpp"
#include "tanglebin/model/axis/settings/link_weights.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/range_image.hpp"

namespace tanglebin {

/// Where a link leads.
struct LinkTarget {
  std::size_t fragment;
  std::size_t node;  ///< index into Fragment::nodes
  /// Index into Fragment::ends: the end at this node, or the end beyond which the junction lies. None for a
  /// junction at the node itself.
  std::optional<std::size_t> end;
  Eigen::Vector3d position;  ///< m, of the end or the junction
};

/// Connects an end of a fragment to what may follow on its tube: an end of another fragment, or a junction,
/// either in the middle of another fragment or hidden beyond its end.
struct Link {
  LinkKind kind;
  std::size_t fragment;
  std::size_t end;  ///< index into Fragment::ends
  LinkTarget to;
  double gap;  ///< m, between the two
  LinkFeatures features;
  double weight = 0;  ///< log odds that the link is true, summed over its ends
};

/// The largest length, m, that a tube of this length (m) may appear to have.
double length_max(double length, const LinkSettings& settings);

/// The weight of a link where whole chains are bent: such a chain may turn sharply where it is hidden, so
/// only the share settings.bent_angles of what angles weigh between ends of chains counts.
double weight_where_bent(const Link& link, const LinkSettings& settings);

/// The possible links between fragments of one kind of tube, heaviest first; those that are likelier not to
/// be true, but would not be where whole chains are bent, weigh 0 or less. The settings limit the turn and
/// the tube's length, and the space between must not have been seen to be empty. For trees, only the
/// likeliest link from each end to each other fragment. Of more than 40,000, those are dropped that weigh
/// least without regard to what was seen of the way and what is in it. `others` is the space that tubes of
/// other kinds fill.
std::vector<Link> find_links(const std::vector<Fragment>& fragments, const RangeImage& seen,
                             const TubeKind& kind, const LinkSettings& settings,
                             const std::vector<Ball>& others = {});

/// Those of the links, heaviest first, that weigh more than 0.
std::vector<Link> likely(const std::vector<Link>& links);

/// The same links with the weights that these settings give them, heaviest first; without those that
/// find_links() would not find by them.
std::vector<Link> weighed(std::vector<Link> links, const LinkSettings& settings);

}  // namespace tanglebin
