#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "tanglebin/model/axis/axis_settings.hpp"
#include "tanglebin/model/axis/fragments.hpp"
#include "tanglebin/model/axis/obstacles.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/range_image.hpp"

namespace tanglebin {

/// The features of a link. Between two ends p and q, let v = q − p, d1 the direction out of the first and d2
/// that into the second, and α = angle(d1, v) + angle(d2, v) as in the paper's Section 4, or angle(d1, d2) if
/// the ends are nearer than a radius. Lengths are in radii. The features are: 1; ln(|v| + 0.16); |v|; α; α²;
/// angle(d1, d2); the
/// fraction of the way on which the sensor saw past a tube; and how far other fragments obstruct the way, as
/// the square root of the mean of Obstacles::overlap() along it, ignoring what is within a diameter of the
/// ends. The way is straight or curved, whichever was seen less to be empty and, if equal, is less
/// obstructed. From an end to a junction at q, α = angle(d1, v), and angle(d1, d2) is replaced by the
/// distance of q beyond the end of its fragment.
inline constexpr std::size_t link_features = 8;
using LinkFeatures = std::array<double, link_features>;

/// The kinds of links.
enum class LinkKind {
  chain_ends,  ///< between two ends of chains
  tree_ends,   ///< between two ends of trees
  junction,    ///< from an end to a junction
};
/// The number of fragment ends that a link of this kind uses up.
constexpr int ends_taken(LinkKind kind) {
  return kind == LinkKind::junction ? 1 : 2;
}

inline constexpr std::array link_kinds = {LinkKind::chain_ends, LinkKind::tree_ends, LinkKind::junction};

/// Weights of the features. Their weighted sum is the log odds, at each of a link's ends, of the link against
/// no link.
struct LinkWeights {
  LinkFeatures chain_ends{};
  LinkFeatures tree_ends{};
  LinkFeatures junction{};

  const LinkFeatures& of(LinkKind kind) const;
};

/// Learned by `tanglebin learn` from recipes/learning.toml, rounded to four decimals.
inline constexpr LinkWeights learned_weights = {
    .chain_ends = {14.1340, -3.7326, 0.1670, -9.4182, 0.3744, 2.8452, -16.8851, -17.5441},
    .tree_ends = {9.2801, -0.9678, -0.2746, -8.7584, 0.6633, 3.9613, -14.3164, -5.1213},
    .junction = {3.9498, -0.6503, -0.2938, -9.4557, 2.7211, -0.9726, -24.7574, 0.9809},
};

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

/// The largest length, m, that a tube of this kind may appear to have.
double length_max(const TubeKind& kind, const LinkSettings& settings);

/// The possible links between fragments of one kind of tube, heaviest first. The settings limit the turn and
/// the tube's length, and the space between must not have been seen to be empty. For trees, only the
/// likeliest link from each end to each other fragment. `others` is the space that tubes of other kinds fill.
std::vector<Link> find_links(const std::vector<Fragment>& fragments, const RangeImage& seen,
                             const TubeKind& kind, const LinkSettings& settings,
                             const std::vector<Ball>& others = {});

}  // namespace tanglebin
