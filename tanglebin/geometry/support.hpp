#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "tanglebin/geometry/bin.hpp"

namespace tanglebin {

/// What the tubes lie in or on. Its own frame is a bin's: z up, origin at the centre of the floor's upper
/// side.
struct Support {
  enum class Shape {
    bin,      ///< an open box
    plane,    ///< a table or a floor without borders
    nothing,  ///< not known, or not in the cloud
  };
  Shape shape = Shape::bin;
  Bin bin{};                                               ///< sizes of a bin
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< support frame → world frame
  double margin = 0;  ///< m, by which the real one may deviate from this shape, either way: ribs, draft
};

/// "bin", "plane" or "nothing". shape_named() is the inverse; it throws InputError for any other name.
std::string name_of(Support::Shape shape);
Support::Shape shape_named(const std::string& name);

/// The solid parts, m, in the support's frame: boxes() of a bin, a slab of 20 mm without borders for a plane,
/// none for nothing.
std::vector<Eigen::AlignedBox3d> solid_parts(const Support& support);

/// Those of the widest and deepest support within the margin: a place in them is solid wherever the real
/// floor and walls are.
std::vector<Eigen::AlignedBox3d> surely_solid_parts(const Support& support);

/// Whether its shape is known so well that whatever is not part of it is a tube: a bin without a margin. On a
/// plane, anything may lie; and a bin with ribs or bent walls may show more than its box.
bool holds_only_tubes(const Support& support);

/// Throws InputError naming the field under `support` unless a bin is valid as validate(Bin) has it, the pose
/// is a rigid motion with finite numbers, and the margin is finite, not negative and at most 0.1 m.
void validate(const Support& support);

}  // namespace tanglebin
