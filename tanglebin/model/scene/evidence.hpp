#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace tanglebin {

/// A join of two visible pieces of a tube across a gap.
struct TubeJoin {
  Eigen::Vector3d from;  ///< m, world frame: the places that it joins
  Eigen::Vector3d to;
  double log_odds;  ///< of this join against none
  double margin;    ///< log odds of this join against the best way to join these ends otherwise
};

/// Whether a tube is as long as its kind is known to be.
enum class LengthFit {
  unknown,    ///< how long it must at least be is not known
  complete,   ///< it is
  too_short,  ///< a part is hidden, or was not found
  too_long,   ///< something is joined to it that is not a part of it, or the known length is wrong
};

/// "unknown", "complete", "too_short" or "too_long".
std::string name_of(LengthFit fit);

/// What speaks for a modelled tube, and against it.
struct TubeEvidence {
  std::size_t kind = 0;         ///< index into KnownScene::kinds
  std::vector<TubeJoin> joins;  ///< empty for methods without odds (paper)
  std::size_t points = 0;       ///< with its label
  double residual = 0;          ///< m, root mean square distance of the points nearest to it from its surface
  double radius_error = 0;      ///< m, by how much a thicker tube would fit these points better, not counting
                                ///< outliers; thinner: < 0
  double unevenness = 0;      ///< m, the same with outliers: large where points of other tubes are among them
  double disagreement = 0;    ///< share of the other models of the cloud, if any, that do not have it
  double length = 0;          ///< m, of its centre line, with all branches
  double visible_length = 0;  ///< m, of the part of the centre line that has points
  LengthFit length_fit = LengthFit::unknown;
  double confidence = 0;  ///< that this is one whole tube, 0 to 1 (docs/algorithm.md)

  /// The visible share of the centre line, 0 to 1.
  double coverage() const { return length > 0 ? visible_length / length : 0; }
};

}  // namespace tanglebin
