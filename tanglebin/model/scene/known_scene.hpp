#pragma once

#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/model/scene/segment_tree.hpp"

namespace tanglebin {

/// What is known of each tube of a kind.
struct TubeKind {
  double radius = 0.0125;                ///< m
  SegmentTree segments = {{1, 2, 0.5}};  ///< one for a chain, several for a tree

  /// m, along its centre line, branches included.
  double length() const { return total_length(segments); }
  /// Whether it is a tree.
  bool branches() const { return segments.size() > 1; }
};

/// What is known of a scene before its cloud is looked at.
struct KnownScene {
  Bin bin;
  Camera camera;                                           ///< that took the cloud
  std::vector<TubeKind> kinds = std::vector<TubeKind>(1);  ///< of tubes, told apart by their radii
};

/// Throws InputError naming the field of a scene that is none: what bin and camera refuse, no kind, a radius
/// that is not a finite positive number, segments that are no tree, a radius of two kinds or too small for
/// the bin.
void validate(const KnownScene& known);

}  // namespace tanglebin
