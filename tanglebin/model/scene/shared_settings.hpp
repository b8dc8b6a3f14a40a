#pragma once

// Settings of the steps that both methods have in common.
namespace tanglebin {

/// Filter: which points are modelled.
struct FilterSettings {
  double margin = 0.0005;  ///< m, a point nearer than this to the bin's walls or floor is the bin's
  double overhang = 0.3;   ///< m, how far beyond the bin, to the sides and upwards, points are kept
};

/// Label: the points that no tube was modelled from.
struct LabelSettings {
  double distance_max = 0.006;  ///< m, from a point to the surface of the tube that it is given to
};

}  // namespace tanglebin
