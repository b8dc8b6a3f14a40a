#pragma once

#include <cmath>
#include <vector>

#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/support.hpp"
#include "tanglebin/model/scene/segment_tree.hpp"

namespace tanglebin {

/// What is known about a kind of tube.
struct TubeKind {
  double radius = 0.0125;                 ///< m
  SegmentTree segments = SegmentTree(1);  ///< at their longest: one for a chain, several for a tree
  double length_min = 0;                  ///< m, of all segments; 0 if it is not known
  bool flat_ends = false;                 ///< cut flat at the outermost nodes, not rounded beyond them

  /// The largest length of the centre line with all branches, m.
  double length() const { return total_length(segments); }
  /// False for a chain of unknown length, whose segment is infinite.
  bool length_is_known() const { return !std::isinf(length()); }
  /// True for a tree.
  bool branches() const { return segments.size() > 1; }
};

/// What is known about a scene in advance.
struct KnownScene {
  Support support{};
  Camera camera;                                           ///< the camera that took the cloud
  std::vector<TubeKind> kinds = std::vector<TubeKind>(1);  ///< no two with the same radius
};

/// Throws InputError naming the invalid field: bin or camera; no kinds; a radius that is not a finite
/// positive number, is too small or too large for the bin or belongs to two kinds; segments that do not form
/// a tree or are together longer than ten times the bin's diagonal; a tree of unknown length; a least length
/// that is negative or above the length.
void validate(const KnownScene& known);

}  // namespace tanglebin
