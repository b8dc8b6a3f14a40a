#pragma once

#include <array>
#include <cstddef>

#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"

namespace tanglebin {

/// What a tube's confidence follows from: 1; the least margin of its joins, in tens, at most 2, and 2 without
/// joins; the fraction of the known length that it lacks, and that it has too much; the hidden share of its
/// centre line; the residual, and the size of the unevenness, in radii, at most 1; the logarithm of the
/// visible length in radii, at least 0; the residual once more, which is large where floors and walls are
/// taken for tubes, and in noise: all of it where no support is known, else what is above 0.15; and the
/// disagreement with other models of the same cloud.
inline constexpr std::size_t confidence_features = 10;
using ConfidenceFeatures = std::array<double, confidence_features>;
ConfidenceFeatures features_of(const TubeEvidence& evidence, const KnownScene& known);

/// Learned by `tanglebin learn --confidence` from recipes/confidence.toml, recipes/confidence-zivid.toml and
/// bars (recipes/bars.toml --seed 16 --tubes 5,10,15 --cases 1-20), told of the support and not, three times,
/// since they choose the model too (axis_method.cpp); rounded to four decimals (docs/robustness.md).
inline constexpr ConfidenceFeatures learned_confidence = {2.7520,  0.3669,  -5.4202, -6.8916,  -2.7477,
                                                          -4.9018, -0.7558, 0.6044,  -12.3302, -1.9428};

/// The probability that the tube is one whole true tube: that at least 95 % of its points are on that tube,
/// and that at least 95 % of that tube's points in the cloud are its own. Mixed points, which lie between
/// surfaces, do not count. The logistic function of the weighted sum of the features.
double confidence(const ConfidenceFeatures& features, const ConfidenceFeatures& weights = learned_confidence);

}  // namespace tanglebin
