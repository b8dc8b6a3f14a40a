#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "tanglebin/model/axis/axis_settings.hpp"
#include "tanglebin/model/axis/fragments.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/range_image.hpp"

namespace tanglebin {

/// What a link is judged by. For two ends: with p and q the ends, d1 and d2 the ways out of the first and
/// into the second, v = q − p, and α = angle(d1, v) + angle(d2, v) as in the paper's Section 4, or angle(d1,
/// d2) where the ends are nearer than a radius: 1, ln(|v| + 2 mm), |v|, α, α², angle(d1, d2), the share of v
/// on which the sensor saw past a tube, and how far other fragments are in the way: √ of the mean of
/// Obstacles::overlap() over v, without what is within a diameter of the ends. For an end and a junction at
/// q: α = angle(d1, v), and instead of angle(d1, d2) how far q is beyond the end of its fragment, m.
inline constexpr std::size_t link_features = 8;
using LinkFeatures = std::array<double, link_features>;

/// What a link may be.
enum class LinkKind {
  chain_ends,  ///< between two ends of chains
  tree_ends,   ///< between two ends of trees
  junction,    ///< from an end to a junction
};
/// How many ends of fragments a link of this kind takes up.
constexpr int ends_taken(LinkKind kind) {
  return kind == LinkKind::junction ? 1 : 2;
}

inline constexpr std::array link_kinds = {LinkKind::chain_ends, LinkKind::tree_ends, LinkKind::junction};

/// The logarithm of the odds of a link against none, at each of its ends, is the sum of its features times
/// these.
struct LinkWeights {
  LinkFeatures chain_ends{};
  LinkFeatures tree_ends{};
  LinkFeatures junction{};

  const LinkFeatures& of(LinkKind kind) const;
};

/// What `tanglebin learn` gives for recipes/learning.toml, to four decimals.
inline constexpr LinkWeights learned_weights = {
    .chain_ends = {-0.8519, -3.3108, 9.6944, -9.6473, 0.3485, 3.0997, -27.6979, -18.3272},
    .tree_ends = {7.0139, -0.5219, -27.4438, -9.2772, 0.7973, 3.9566, -17.2631, -4.8847},
    .junction = {2.2849, -0.4197, -29.2340, -9.4838, 2.7325, -82.6329, -21.1044, -2.1218},
};

/// Where a link leads to.
struct LinkTarget {
  std::size_t fragment;
  std::size_t node;  ///< index into Fragment::nodes
  /// Index into Fragment::ends: the end that has this node, or beyond which the junction is; none for a
  /// junction at the node.
  std::optional<std::size_t> end;
  Eigen::Vector3d position;  ///< m, of the end or the junction
};

/// An end of a fragment, and what may be next on its tube: an end of another fragment, or a junction in the
/// middle of one or, hidden, beyond its end.
struct Link {
  LinkKind kind;
  std::size_t fragment;
  std::size_t end;  ///< index into Fragment::ends
  LinkTarget to;
  double gap;  ///< m, in between
  LinkFeatures features;
  double weight = 0;  ///< the logarithm of the odds that it is true, for all of its ends together
};

/// m, the longest that a tube of the kind may seem.
double length_max(const TubeKind& kind, const LinkSettings& settings);

/// The links that there may be between fragments of tubes of a kind, the heaviest first: no turn sharper, no
/// tube longer than the settings allow, and the space between was not seen to be empty. Where tubes branch,
/// of each end and other fragment the likeliest.
std::vector<Link> find_links(const std::vector<Fragment>& fragments, const RangeImage& seen,
                             const TubeKind& kind, const LinkSettings& settings);

}  // namespace tanglebin
