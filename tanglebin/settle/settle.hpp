#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// How tubes fall and come to rest. Gravity, friction and the solver are those of the published worlds, but
/// for a smaller step and surface layer and a correction of overlaps, which keep these small, and half the
/// iterations.
struct SettleSettings {
  double gravity = 9.8;           ///< m/s²
  double friction = 1.16;         ///< Coulomb, tube on tube; on the bin: the smaller of this and the bin's
  double step = 0.002;            ///< s
  int iterations = 50;            ///< of the contact solver, each step; half as many again ...
  int iterations_max = 200;       ///< ... up to this after each test of rest that a heap fails
  double sor = 1.3;               ///< the solver's over-relaxation
  double erp = 0.2;               ///< share of an overlap that is corrected each step
  double surface_layer = 0.0001;  ///< m, overlap that a resting contact keeps
  double correction_speed = 0.5;  ///< m/s, the fastest correction of an overlap
  double calm_speed = 1.0;        ///< m/s: a heap all of whose nodes are slower is down and may be damped
  double calm_time = 0.3;         ///< s, in which the damping of a heap that is down grows to ...
  double calm_damping = 0.03;     ///< ... this share of all speeds, lost in each step
  double rest_speed = 0.02;       ///< m/s: a heap all of whose nodes are slower ...
  double rest_time = 0.05;        ///< ... for so many s may be at rest, and is tested
  double proof_time = 0.25;       ///< s, the test: laid down without speed and let go, undamped, ...
  double proof_motion = 0.001;    ///< ... no node may be more than so many m from where it began
  double overlap_max = 0.0003;    ///< m, of a tube with another or with the bin
  double time_limit = 10.0;       ///< s, simulated, after which a heap is given up

  bool operator==(const SettleSettings&) const = default;
};

/// A heap as it came out of the simulation.
struct Settled {
  std::vector<Tube> tubes;       ///< where they lie at the end, in whole nanometres as the files hold them
  double simulated = 0.0;        ///< s, how long they took, without the tests of rest
  double largest_overlap = 0.0;  ///< m, at the end, of a tube with another or with the bin
  std::string fault;             ///< why the heap is not valid; empty where it is
};

/// Drops `tubes`, which must not overlap, into the bin and integrates until they rest, one has left the bin,
/// or the time is up. They rest, and the heap is valid, when fault_of_heap() finds nothing. Bodies are never
/// put to sleep. The same arguments give the same heap. ODE's random generator is one for the process: one
/// call at a time. Throws InputError for a tube without mass.
Settled settle(const std::vector<Tube>& tubes, const Bin& bin, const SettleSettings& settings,
               std::uint64_t seed);

/// Says by what tubes, whose masses are known, are no valid heap; empty where they are one: no overlap
/// exceeds overlap_max, every centre of mass is between the walls (a full bin's heap may rise over the rim),
/// and when they are laid into the bin where they are, without speed, no node moves more than proof_motion in
/// proof_time without damping, the solver making iterations_max iterations.
std::string fault_of_heap(const std::vector<Tube>& tubes, const Bin& bin, const SettleSettings& settings);

/// Throws InputError naming the field under `settle` that is out of range.
void validate(const SettleSettings& settings);

}  // namespace tanglebin
