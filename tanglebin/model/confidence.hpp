#pragma once

#include <array>
#include <cstddef>

#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"

namespace tanglebin {

/// What a tube's confidence follows from: 1; the least margin of its joins, in tens, at most 2, and 2 without
/// joins; the fraction of the known length that it lacks, and that it has too much; the hidden share of its
/// centre line; the residual, and the size of the radius error, in radii, at most 1; and the logarithm of the
/// visible length in radii, at least 0.
inline constexpr std::size_t confidence_features = 8;
using ConfidenceFeatures = std::array<double, confidence_features>;
ConfidenceFeatures features_of(const TubeEvidence& evidence, const TubeKind& kind);

/// Learned by `tanglebin learn --confidence` from recipes/confidence.toml and
/// recipes/confidence-zivid.toml, rounded to four decimals.
inline constexpr ConfidenceFeatures learned_confidence = {-0.6458, 1.4743,  -8.7364, -3.8921,
                                                          -1.9876, -8.2361, -7.0669, 1.0000};

/// The probability that the tube is one whole true tube: that at least 95 % of its points are on that tube,
/// and that at least 95 % of that tube's points in the cloud are its own. Mixed points, which lie between
/// surfaces, do not count. The logistic function of the weighted sum of the features.
double confidence(const ConfidenceFeatures& features, const ConfidenceFeatures& weights = learned_confidence);

}  // namespace tanglebin
