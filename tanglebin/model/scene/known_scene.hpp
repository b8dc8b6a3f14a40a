#pragma once

#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/model/scene/segment_tree.hpp"

namespace tanglebin {

/// What is known about a kind of tube.
struct TubeKind {
  double radius = 0.0125;                 ///< m
  SegmentTree segments = SegmentTree(1);  ///< one for a chain, several for a tree

  /// Length of the centre line with all branches, m.
  double length() const { return total_length(segments); }
  /// True for a tree.
  bool branches() const { return segments.size() > 1; }
};

/// What is known about a scene in advance.
struct KnownScene {
  Bin bin;
  Camera camera;                                           ///< the camera that took the cloud
  std::vector<TubeKind> kinds = std::vector<TubeKind>(1);  ///< no two with the same radius
};

/// Throws InputError naming the invalid field: bin or camera; no kinds; a radius that is not a finite
/// positive number, is too small or too large for the bin or belongs to two kinds; segments that do not form
/// a tree or are together longer than ten times the bin's diagonal.
void validate(const KnownScene& known);

}  // namespace tanglebin
