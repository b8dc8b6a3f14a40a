#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/settle/settle.hpp"

namespace tanglebin {

/// Settings of a single step.
struct StepSettings {
  int iterations;  ///< of the contact solver
  double damping;  ///< fraction of its linear and angular speed that every tube loses
};

/// How a tube has moved since its world began, and how fast it is.
struct TubeMotion {
  Eigen::Isometry3d moved;  ///< from its first to its current pose, world frame
  Eigen::Vector3d linear;   ///< m/s, of its centre of mass
  Eigen::Vector3d angular;  ///< rad/s
};

/// Rigid tubes and a bin in ODE. Each tube is a body with its true mass and inertia, and a capsule for each
/// cylinder, within its flat ends (rounded()). Only one world may be in use at a time in a process: the
/// solver uses ODE's single random generator, which the constructor seeds.
class World {
public:
  /// Throws InputError for a tube whose mass is not positive, such as one read from the text format.
  World(const std::vector<Tube>& tubes, const Bin& bin, const SettleSettings& settings, std::uint64_t seed);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  World(World&&) = delete;
  World& operator=(World&&) = delete;

  /// Advances by settings.step.
  void step(const StepSettings& how);

  /// Simulated time, s.
  double time() const;

  /// Speed of the fastest node of all tubes, m/s.
  double fastest_node() const;

  /// How far the node is that is farthest from where it is in `start`, the same tubes elsewhere, m.
  double largest_motion(const std::vector<Tube>& start) const;

  /// The tubes' centres of mass, m.
  std::vector<Eigen::Vector3d> centres_of_mass() const;

  /// Kinetic and potential energy of all tubes, J. Zero for tubes at rest with their centres at floor height.
  double energy() const;

  /// How each tube has moved.
  std::vector<TubeMotion> motions() const;

  /// Moves each tube from its current pose as the motion says, and gives it the motion's speeds.
  void move_on(const std::vector<TubeMotion>& motions);

  /// The tubes in their current positions.
  std::vector<Tube> tubes() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tanglebin
