#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// How tubes fall and come to rest. Gravity, friction and solver are those of the published worlds, except
/// for a smaller step, surface layer and overlap correction, which keep overlaps small, and half the
/// iterations.
struct SettleSettings {
  double gravity = 9.8;      ///< m/s²
  double friction = 1.16;    ///< Coulomb, between tubes; against the bin: the smaller of this and the bin's
  double step = 0.002;       ///< s
  int iterations = 50;       ///< of the contact solver in each step
  int iterations_max = 200;  ///< the same in the test of rest
  double sor = 1.3;          ///< the solver's over-relaxation
  double erp = 0.2;          ///< fraction of an overlap that is corrected in each step
  double surface_layer = 0.0001;  ///< m, overlap that a resting contact keeps
  double correction_speed = 0.5;  ///< m/s, maximum speed of the correction of an overlap
  double calm_speed = 1.0;        ///< m/s; when all nodes are slower, the heap is down and may be damped
  double calm_time = 0.3;         ///< s, in which the damping then grows to ...
  double calm_damping = 0.03;     ///< ... this fraction of all speeds per step
  double rest_speed = 0.02;       ///< m/s; when all nodes are slower than this ...
  double rest_time = 0.05;        ///< ... for this many seconds, the heap is tested for rest
  double proof_time = 0.25;     ///< s, duration of the test, in which the heap starts without speed, undamped
  double proof_motion = 0.001;  ///< m, maximum displacement of a node in the test
  double overlap_max = 0.0003;  ///< m, maximum overlap of a tube with another or with the bin
  double time_limit = 10.0;     ///< s of simulated time, after which a heap is given up

  bool operator==(const SettleSettings&) const = default;
};

/// The fault of a heap of which a tube left the bin, while it fell.
inline constexpr const char* tube_left_the_bin = "a tube left the bin";

/// The result of a simulation.
struct Settled {
  std::vector<Tube> tubes;       ///< at the end, rounded to whole nanometres as in the files
  double simulated = 0.0;        ///< s, until the end, without the tests of rest
  double largest_overlap = 0.0;  ///< m, at the end, of a tube with another or with the bin
  std::string fault;             ///< why the heap is invalid; empty if it is valid
};

/// Drops `tubes`, which must not overlap, into the bin and integrates until they rest, one has left the bin,
/// or the time is up. The heap is valid if fault_of_heap() finds no fault. One that moves too far in the test
/// of rest goes on from where the test left it. Bodies are never put to sleep. The same arguments give the
/// same heap. Not thread-safe: ODE has one random generator per process. Calls `at_step` after each step with
/// the time simulated so far, s; what it throws ends the simulation. Throws InputError as validate(Tube)
/// does, and for a tube that the solver cannot take: without mass, or with a mass, size or place beyond all
/// reason.
Settled settle(
    const std::vector<Tube>& tubes, const Bin& bin, const SettleSettings& settings, std::uint64_t seed,
    const std::function<void(double)>& at_step = [](double) {});

/// Describes what is wrong with a heap of tubes with known masses; empty if it is valid. In a valid heap no
/// overlap exceeds overlap_max, and every centre of mass is between the walls (the heap of a full bin may
/// rise above the rim). If the tubes are put into the bin in place without speed, no node moves more than
/// proof_motion in proof_time, without damping and with iterations_max solver iterations. Throws InputError
/// as settle() does.
std::string fault_of_heap(const std::vector<Tube>& tubes, const Bin& bin, const SettleSettings& settings);

/// Throws InputError naming the field under `settle` that is out of range.
void validate(const SettleSettings& settings);

}  // namespace tanglebin
