#include "tanglebin/settle/settle.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tanglebin/base/error.hpp"
#include "tanglebin/settle/overlap.hpp"
#include "tanglebin/settle/world.hpp"

namespace tanglebin {
namespace {

// The longest possible free fall, after which every tube has met the bin or another tube.
double longest_fall(const std::vector<Tube>& tubes, double gravity) {
  double top = 0;
  for (const Tube& tube : tubes) top = std::max(top, bounds(tube).max().z());
  return std::sqrt(2 * top / gravity);
}

// True if every centre of mass is between the outer sides of the walls. A tube beyond them does not come
// back.
bool are_over_the_bin(const std::vector<Eigen::Vector3d>& centres, const Bin& bin) {
  return std::ranges::all_of(centres, [&](const Eigen::Vector3d& centre) {
    return std::abs(centre.x()) < bin.length / 2 + bin.wall &&
           std::abs(centre.y()) < bin.width / 2 + bin.wall;
  });
}

/// The outcome of a test of rest.
struct RestTest {
  std::string fault{};                     ///< why the tubes are not clear and at rest; empty if they are
  std::vector<TubeMotion> motions{};       ///< when a node had moved too far; empty if none did
  std::vector<Eigen::Vector3d> centres{};  ///< of mass, where the tubes were put down; empty if they overlap
};

// Puts the tubes down without speed, releases them and watches them.
RestTest test_rest(const std::vector<Tube>& tubes, const Bin& bin, const SettleSettings& settings) {
  if (const double overlap = largest_tube_overlap(tubes); overlap > settings.overlap_max) {
    return {.fault = fmt::format("two tubes overlap by {:.2f} mm", 1e3 * overlap)};
  }
  if (const double overlap = largest_bin_overlap(tubes, bin); overlap > settings.overlap_max) {
    return {.fault = fmt::format("a tube overlaps the bin by {:.2f} mm", 1e3 * overlap)};
  }
  World world(tubes, bin, settings, 0);
  const std::vector<Eigen::Vector3d> centres = world.centres_of_mass();
  while (world.time() < settings.proof_time) {
    world.step({.iterations = settings.iterations_max, .damping = 0});
    const double motion = world.largest_motion(tubes);
    if (motion > settings.proof_motion) {
      return {.fault = fmt::format("no rest: a node moved {:.2f} mm in {:.3g} s", 1e3 * motion, world.time()),
              .motions = world.motions(),
              .centres = centres};
    }
  }
  return {.centres = centres};
}

std::string fault_of_place(const std::vector<Eigen::Vector3d>& centres, const Bin& bin) {
  const bool are_inside = std::ranges::all_of(centres, [&](const Eigen::Vector3d& centre) {
    return std::abs(centre.x()) < bin.length / 2 && std::abs(centre.y()) < bin.width / 2 && centre.z() > 0;
  });
  return are_inside ? "" : "a centre of mass is outside the bin";
}

// Rounds to what the files hold, so that what was tested is what will be read.
std::vector<Tube> in_whole_nanometres(std::vector<Tube> tubes) {
  for (Tube& tube : tubes) round_to_nanometres(tube);
  return tubes;
}

}  // namespace

Settled settle(const std::vector<Tube>& tubes, const Bin& bin, const SettleSettings& settings,
               std::uint64_t seed, const std::function<void(double)>& at_step) {
  World world(tubes, bin, settings, seed);
  const double fall_time = longest_fall(tubes, settings.gravity);
  const double damping_growth = settings.calm_damping * settings.step / settings.calm_time;
  double damping = 0;
  double slow_since = 0;
  std::string fault = "no rest: the heap never slowed down";
  while (world.time() < settings.time_limit) {
    world.step({.iterations = settings.iterations, .damping = damping});
    at_step(world.time());
    if (!are_over_the_bin(world.centres_of_mass(), bin)) {
      fault = tube_left_the_bin;
      break;
    }
    const double speed = world.fastest_node();
    const bool is_down = damping > 0 || (world.time() > fall_time && speed < settings.calm_speed);
    if (is_down) damping = std::min(settings.calm_damping, damping + damping_growth);
    if (speed > settings.rest_speed) slow_since = world.time();
    if (world.time() - slow_since < settings.rest_time) continue;

    const std::vector<Tube> heap = in_whole_nanometres(world.tubes());
    const RestTest test = test_rest(heap, bin, settings);
    fault = test.fault;
    if (fault.empty()) {
      fault = fault_of_place(test.centres, bin);
      break;
    }
    // A tube that rolls to its lowest place, or swings, does so too slowly in the damped world.
    world.move_on(test.motions);
    slow_since = world.time();
  }
  std::vector<Tube> heap = in_whole_nanometres(world.tubes());
  const double overlap = std::max(largest_tube_overlap(heap), largest_bin_overlap(heap, bin));
  return {std::move(heap), world.time(), overlap, std::move(fault)};
}

std::string fault_of_heap(const std::vector<Tube>& tubes, const Bin& bin, const SettleSettings& settings) {
  const RestTest test = test_rest(tubes, bin, settings);
  return test.fault.empty() ? fault_of_place(test.centres, bin) : test.fault;
}

void validate(const SettleSettings& settings) {
  const auto require = [](bool good, const char* field, double found, const char* expected) {
    if (good) return;
    throw InputError({"", 0, fmt::format("settle.{}", field)}, fmt::format("{}", found), expected);
  };
  const auto positive = [&](double value, const char* field) {
    require(std::isfinite(value) && value > 0, field, value, "a positive number");
  };
  const auto not_negative = [&](double value, const char* field) {
    require(std::isfinite(value) && value >= 0, field, value, "zero or a positive number");
  };
  positive(settings.gravity, "gravity");
  not_negative(settings.friction, "friction");
  require(settings.step > 0 && settings.step <= 0.01, "step", settings.step, "more than 0, at most 0.01 s");
  require(settings.iterations >= 1, "iterations", settings.iterations, "at least 1");
  require(settings.iterations_max >= settings.iterations, "iterations_max", settings.iterations_max,
          "at least settle.iterations");
  require(settings.sor > 0 && settings.sor < 2, "sor", settings.sor, "more than 0, less than 2");
  require(settings.erp >= 0 && settings.erp <= 1, "erp", settings.erp, "0 to 1");
  not_negative(settings.surface_layer, "surface_layer");
  not_negative(settings.correction_speed, "correction_speed");
  positive(settings.calm_speed, "calm_speed");
  positive(settings.calm_time, "calm_time");
  require(settings.calm_damping >= 0 && settings.calm_damping < 1, "calm_damping", settings.calm_damping,
          "0 to less than 1");
  positive(settings.rest_speed, "rest_speed");
  positive(settings.rest_time, "rest_time");
  positive(settings.proof_time, "proof_time");
  positive(settings.proof_motion, "proof_motion");
  positive(settings.overlap_max, "overlap_max");
  positive(settings.time_limit, "time_limit");
  require(settings.time_limit <= 1e6 * settings.step, "step", settings.step,
          "at least a millionth of settle.time_limit");
}

}  // namespace tanglebin
