#pragma once

// Settings of the steps that both methods share.
namespace tanglebin {

/// Filter: selects the points to model.
struct FilterSettings {
  double margin = 0.0005;  ///< m; a point nearer than this to a wall or the floor belongs to the bin
  double overhang = 0.3;   ///< m; points farther than this outside the bin, sideways or upwards, are dropped
};

/// Label: assigns the points that no tube was modelled from.
struct LabelSettings {
  double distance_max = 0.48;  ///< radii, from a point to the surface of its tube
};

}  // namespace tanglebin
