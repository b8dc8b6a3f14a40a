#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace tanglebin {

/// The features of a link. Between two ends p and q, let v = q − p, d1 the direction out of the first and d2
/// that into the second, and α = angle(d1, v) + angle(d2, v) as in the paper's Section 4, or angle(d1, d2) if
/// the ends are nearer than a radius. Lengths are in radii. The features are:
/// 1, ln(|v| + 0.16), |v|, α, α², and β = angle(d1, d2);
/// the fraction of the way on which the sensor saw past a tube;
/// how far other fragments obstruct the way, as the square root of the mean of Obstacles::overlap() along it,
/// ignoring what is within a diameter of the ends;
/// α² / (|v| + 2) and β² / (|v| + 2), since a tube with random bends turns by the square root of its length;
/// how many of the two ends were seen to be a tube's end, and Σ ln(1 + h) over them, h = FragmentEnd::hidden.
/// The way is straight or curved, whichever was seen less to be empty and, if equal, is less obstructed. From
/// an end to a junction at q, α = angle(d1, v), β is replaced by the distance of q beyond the end of its
/// fragment, β² / (|v| + 2) is 0, and the last two are of the one end.
inline constexpr std::size_t link_features = 12;
using LinkFeatures = std::array<double, link_features>;

/// Indices of the features of links between ends that say how sharply the tube turns.
inline constexpr std::array<std::size_t, 5> angle_features = {3, 4, 5, 8, 9};

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
/// "angle_squared", "turn" ("beyond" of a junction), "seen_empty", "obstruction", "angle_rate", "turn_rate",
/// "seen_ends", "hidden".
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

/// Learned by `tanglebin learn` from recipes/learning.toml and recipes/learning-views.toml, rounded to four
/// decimals.
inline constexpr LinkWeights learned_weights = {
    .chain_ends = {12.7730, -1.9205, 0.0000, -9.4036, 1.1869, 3.3541, -6.9187, -9.6619, -0.3325, -4.1566,
                   -2.1049, -0.4889},
    .tree_ends = {11.1742, -1.5026, -0.2483, -9.8905, 0.9548, 4.8162, -14.1562, -4.7583, 0.2393, -1.6935,
                  -1.0951, -0.1948},
    .junction = {3.5911, -0.7635, -0.3208, -9.3447, 2.7652, -1.0841, -23.1571, 1.0808, -0.2595, 0.0000,
                 0.1299, 0.3080},
};

}  // namespace tanglebin
