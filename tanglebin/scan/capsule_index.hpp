#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <vector>

#include "tanglebin/geometry/capsule.hpp"

namespace tanglebin {

/// The smallest axis-aligned box around the capsules; empty if there are none.
Eigen::AlignedBox3d bounding_box(const std::vector<Capsule>& capsules);

/// The shape of a beam: all rays from one point whose directions deviate little from a central one.
struct BeamShape {
  Eigen::Vector3d origin;  ///< m, world frame
  double spread;           ///< sine of the largest angle between a ray and the central direction
};

/// Radius (m) of a thickened capsule. Wherever a ray of the beam meets the true capsule, the central ray
/// meets the thickened one at the same distance or nearer.
double radius_for_beam(const Capsule& capsule, const BeamShape& beam);

/// Finds the capsules that the rays of a beam may meet, their ends taken as round: an Embree scene of
/// capsules, each thickened by the beam's spread at its distance (radius_for_beam()). ray_capsule() then
/// decides for each ray of the beam.
class CapsuleIndex {
public:
  /// For beams of this shape in any direction. Throws std::runtime_error if Embree fails.
  CapsuleIndex(const std::vector<Capsule>& capsules, const BeamShape& beam);
  ~CapsuleIndex();
  CapsuleIndex(const CapsuleIndex&) = delete;
  CapsuleIndex& operator=(const CapsuleIndex&) = delete;

  /// Writes to `found`, in ascending order, the indices of all capsules that a ray of the beam around
  /// `direction` (a unit vector) meets, and of a few that none meets.
  void candidates(const Eigen::Vector3d& direction, std::vector<std::size_t>& found) const;

private:
  struct Embree;

  Eigen::Vector3d origin_;             ///< of all rays, m
  Eigen::Vector3d centre_;             ///< of a sphere around all thickened capsules, m
  double radius_ = 0;                  ///< of that sphere, m
  std::vector<Eigen::Vector3d> axes_;  ///< of the capsules, unit vectors
  std::vector<std::size_t> stubs_;     ///< capsules too short for Embree
  std::unique_ptr<Embree> embree_;
};

}  // namespace tanglebin
