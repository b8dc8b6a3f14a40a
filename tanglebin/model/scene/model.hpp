#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/scene/evidence.hpp"
#include "tanglebin/model/scene/finding.hpp"

namespace tanglebin {

/// The outcome of one step of a method.
struct Step {
  std::string name;   ///< "filter", "segment", …
  double seconds;     ///< wall clock
  std::size_t count;  ///< number of items the step produced
  std::string of;     ///< what the items are: "points", "clusters", …
};

/// The length of a kind of tubes for which none was told.
struct EstimatedLength {
  std::size_t kind;  ///< index into KnownScene::kinds
  double length;     ///< m
};

/// The tubes found in a cloud.
struct Model {
  std::vector<Tube> tubes;            ///< ids 1, 2, …; mass 0 (unknown)
  std::vector<std::int32_t> labels;   ///< for each point of the cloud: a tube's id, bin_label or null_label
  std::vector<std::size_t> filtered;  ///< points that the filter kept, ascending; Section 5 scores these
  std::vector<Step> steps;            ///< in the order in which they ran
  std::vector<TubeEvidence> evidence{};  ///< for each tube: how sure it is
  std::vector<double> foreign_radii{};   ///< m, of each tube that no kind has the radius of: left unexplained
  std::vector<EstimatedLength>
      estimated_lengths{};          ///< of the kinds whose length was not told, but stands out
  std::size_t pieces_left_out = 0;  ///< the smallest that may be of tubes, where there were too many
  PointCounts counts{};
  std::vector<Finding> findings{};  ///< what does not fit: errors, then warnings; empty if all is well

  /// Whether an error was found: then the tubes are not to be used.
  bool is_refused() const {
    return std::ranges::any_of(
        findings, [](const Finding& finding) { return finding.severity == Finding::Severity::error; });
  }
};

}  // namespace tanglebin
