#include "tanglebin/model/scene/confidence.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tanglebin {

ConfidenceFeatures features_of(const TubeEvidence& evidence, const KnownScene& known) {
  const TubeKind& kind = known.kinds.at(evidence.kind);
  constexpr double tens = 10;
  constexpr double most = 2;
  double margin = most;
  for (const TubeJoin& join : evidence.joins) margin = std::min(margin, join.margin / tens);
  const double lacking = kind.length_min > 0 ? std::max(0.0, 1 - evidence.length / kind.length_min) : 0;
  const double excess = kind.length_is_known() ? std::max(0.0, evidence.length / kind.length() - 1) : 0;
  const double residual = std::min(1.0, evidence.residual / kind.radius);
  constexpr double usual_max = 0.15;  // in a bin or on a plane
  const double usual = known.support.shape == Support::Shape::nothing ? 0 : usual_max;
  return {1,
          margin,
          lacking,
          excess,
          1 - evidence.coverage(),
          residual,
          std::min(1.0, std::abs(evidence.unevenness) / kind.radius),
          std::log(std::max(1.0, evidence.visible_length / kind.radius)),
          std::max(0.0, residual - usual),
          evidence.disagreement};
}

double confidence(const ConfidenceFeatures& features, const ConfidenceFeatures& weights) {
  const double log_odds = std::inner_product(features.begin(), features.end(), weights.begin(), 0.0);
  return 1 / (1 + std::exp(-log_odds));
}

}  // namespace tanglebin
