#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/support.hpp"
#include "tanglebin/model/scene/segment_tree.hpp"

namespace tanglebin {

/// The smallest and the largest radius of a tube, m. They keep the indices of grids with tube-wide cells in
/// range.
inline constexpr double thinnest_radius = 1e-4;
inline constexpr double thickest_radius = 1;

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

/// Throws InputError naming the invalid field, such as "kinds[0].radius": bin or camera; no kinds; a radius
/// that is not a finite positive number, is too small or too large for the bin or belongs to two kinds;
/// segments that do not form a tree or are together longer than ten times the bin's diagonal; a tree of
/// unknown length; a least length that is negative or above the length.
void validate(const KnownScene& known);

/// Throws InputError naming the field in `list`, such as "kinds[0].radius" of "kinds", if a kind is too large
/// for the support's bin or has the radius of another. A radius of 0 is not known.
void validate_together(const std::vector<TubeKind>& kinds, const Support& support, const std::string& list);

/// The name of the field that gives a kind its length: "length", or "segment" of a tree.
std::string field_of_length(const TubeKind& kind);

}  // namespace tanglebin
