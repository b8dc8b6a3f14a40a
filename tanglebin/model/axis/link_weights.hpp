#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace tanglebin {

/// The features of a link. Between two ends p and q, let v = q − p, d1 the direction out of the first and d2
/// that into the second, and α = angle(d1, v) + angle(d2, v) as in the paper's Section 4, or angle(d1, d2) if
/// the ends are nearer than a radius. Lengths are in radii. The features are: 1; ln(|v| + 0.16); |v|; α; α²;
/// angle(d1, d2); the fraction of the way on which the sensor saw past a tube; and how far other fragments
/// obstruct the way, as the square root of the mean of Obstacles::overlap() along it, ignoring what is within
/// a diameter of the ends. The way is straight or curved, whichever was seen less to be empty and, if equal,
/// is less obstructed. From an end to a junction at q, α = angle(d1, v), and angle(d1, d2) is replaced by the
/// distance of q beyond the end of its fragment.
inline constexpr std::size_t link_features = 8;
using LinkFeatures = std::array<double, link_features>;

/// The kinds of links.
enum class LinkKind {
  chain_ends,  ///< between two ends of chains
  tree_ends,   ///< between two ends of trees
  junction,    ///< from an end to a junction
};
inline constexpr std::array link_kinds = {LinkKind::chain_ends, LinkKind::tree_ends, LinkKind::junction};

/// The number of fragment ends that a link of this kind uses up.
constexpr int ends_taken(LinkKind kind) {
  return kind == LinkKind::junction ? 1 : 2;
}

/// "chain_ends", "tree_ends" or "junction".
std::string_view name_of(LinkKind kind);

/// The name of a link's feature, 0 to link_features − 1: "constant", "log_gap", "gap", "angle",
/// "angle_squared", "turn" ("beyond" of a junction), "seen_empty", "obstruction".
std::string_view feature_name(LinkKind kind, std::size_t feature);

/// Weights of the features. Their weighted sum is the log odds, at each of a link's ends, of the link against
/// no link.
struct LinkWeights {
  LinkFeatures chain_ends{};
  LinkFeatures tree_ends{};
  LinkFeatures junction{};

  const LinkFeatures& of(LinkKind kind) const;
  LinkFeatures& of(LinkKind kind);
};

/// Learned by `tanglebin learn` from recipes/learning.toml, rounded to four decimals.
inline constexpr LinkWeights learned_weights = {
    .chain_ends = {14.1340, -3.7326, 0.1670, -9.4182, 0.3744, 2.8452, -16.8851, -17.5441},
    .tree_ends = {9.2801, -0.9678, -0.2746, -8.7584, 0.6633, 3.9613, -14.3164, -5.1213},
    .junction = {3.9498, -0.6503, -0.2938, -9.4557, 2.7211, -0.9726, -24.7574, 0.9809},
};

}  // namespace tanglebin
