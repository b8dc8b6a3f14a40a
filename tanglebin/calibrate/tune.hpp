#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "tanglebin/calibrate/race.hpp"
#include "tanglebin/model/parameters.hpp"

namespace tanglebin {

/// How the score changes if one parameter of the best is moved alone, on a few scenes.
struct Sensitivity {
  std::string name;
  double down;  ///< difference of the mean score
  double up;
};

/// The parameters of a method that a calibration may change.
std::vector<Parameter> tunable_parameters(Method method);

/// The value of a parameter at a place of its range, 0 to 1, and the inverse; a value outside of the range is
/// at its nearer end. Values have three digits, and counts are whole.
double value_at(const Parameter& parameter, double place);
double place_of(const Parameter& parameter, double value);

/// Moves each parameter of the best by this part of its range.
std::vector<Sensitivity> sensitivities(const Race& race, const std::vector<Parameter>& parameters,
                                       double step, Look look);

/// Improves the best of a race in three rounds, of ever smaller steps: glances at all parameters and tries
/// the moves that seem to help; looks closer at those parameters that move the score most, the same; then
/// searches the first of them together (search_cube()). Calls `looked` with what it saw in the first round,
/// and again after the closer look.
void tune(
    Race& race, const std::vector<Parameter>& parameters,
    const std::function<void(const std::vector<Sensitivity>&)>& looked = [](const auto&) {});

/// The parameters that differ, by name; all weights of links as one.
std::set<std::string> groups_of_differences(const Parameters& one, const Parameters& other);

/// Puts each parameter back to its value in `start` without whose change the best is as good. All weights of
/// links are put back together.
void keep_what_helps(Race& race, const Parameters& start);

}  // namespace tanglebin
