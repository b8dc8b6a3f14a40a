#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// What a step of a method left, and how long it took.
struct Step {
  std::string name;   ///< "filter", "segment", …
  double seconds;     ///< wall clock
  std::size_t count;  ///< how many things it left
  std::string of;     ///< what these are: "points", "clusters", …
};

/// Tubes found in a cloud.
struct Model {
  std::vector<Tube> tubes;            ///< ids 1, 2, …, of mass 0 (not known)
  std::vector<std::int32_t> labels;   ///< a tube's id, bin_label or null_label for each point of the cloud
  std::vector<std::size_t> filtered;  ///< the points that the method's filter left, ascending; Section 5
                                      ///< scores their labels
  std::vector<Step> steps;            ///< in their order
};

}  // namespace tanglebin
