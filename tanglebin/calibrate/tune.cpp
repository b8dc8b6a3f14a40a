#include "tanglebin/calibrate/tune.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "tanglebin/base/text.hpp"
#include "tanglebin/calibrate/search.hpp"

namespace tanglebin {
namespace {

// Three digits: a profile is for people too.
double rounded_to_digits(double value) {
  return to_number<double>(fmt::format("{:.3g}", value)).value_or(value);
}

double value_in(const Parameters& parameters, const Parameter& parameter) {
  const auto found = parameters.find(parameter.name);
  return found == parameters.end() ? parameter.standard : found->second;
}

Parameters with(Parameters parameters, const Parameter& parameter, double value) {
  if (value == parameter.standard)
    parameters.erase(parameter.name);
  else
    parameters[parameter.name] = value;
  return parameters;
}

// The best, with one parameter moved by a part of its range.
Parameters moved(const Parameters& best, const Parameter& parameter, double by) {
  const double place = place_of(parameter, value_in(best, parameter));
  return with(best, parameter, value_at(parameter, place + by));
}

double gain(const Sensitivity& sensitivity) {
  return std::max(sensitivity.down, sensitivity.up);
}

double effect(const Sensitivity& sensitivity) {
  return std::max(std::abs(sensitivity.down), std::abs(sensitivity.up));
}

// The numbers of those parameters for which `amount` is above `least`, the greatest amount first.
template <typename Amount>
std::vector<std::size_t> ranked(const std::vector<Sensitivity>& seen, const Amount& amount, double least) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (amount(seen[i]) > least) order.push_back(i);
  }
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return amount(seen[i]); });
  return order;
}

void try_moves_that_help(Race& race, const std::vector<Parameter>& parameters,
                         const std::vector<Sensitivity>& seen, double step) {
  for (const std::size_t i : ranked(seen, gain, 0)) {
    const Parameters candidate = moved(race.best(), parameters[i], seen[i].up > seen[i].down ? step : -step);
    if (race.advantage(candidate, Look::heat) > 0) race.run(candidate);
  }
}

void search_together(Race& race, const std::vector<Parameter>& parameters, double step) {
  constexpr int values_of_parameter = 10;
  const Parameters start = race.best();
  CubeSearch search{.start = {},
                    .step = step / 2,
                    .finest = step / 10,
                    .most = values_of_parameter * static_cast<int>(parameters.size())};
  for (const Parameter& parameter : parameters)
    search.start.push_back(place_of(parameter, value_in(start, parameter)));
  search_cube(search, [&](const CubePoint& point) {
    Parameters candidate = start;
    for (std::size_t i = 0; i < point.size(); ++i)
      candidate = with(std::move(candidate), parameters[i], value_at(parameters[i], point[i]));
    return race.run(candidate);
  });
}

// At most so many, those that move the score most first.
std::vector<Parameter> those_that_matter(const std::vector<Parameter>& parameters,
                                         const std::vector<Sensitivity>& seen, std::size_t most) {
  constexpr double least_effect = 5e-4;
  std::vector<Parameter> matter;
  for (const std::size_t i : ranked(seen, effect, least_effect)) {
    if (matter.size() < most) matter.push_back(parameters[i]);
  }
  return matter;
}

// What was seen at a glance, but for what was looked at closer.
std::vector<Sensitivity> with_closer(std::vector<Sensitivity> seen, const std::vector<Sensitivity>& closer) {
  for (Sensitivity& its : seen) {
    const auto found = std::ranges::find(closer, its.name, &Sensitivity::name);
    if (found != closer.end()) its = *found;
  }
  return seen;
}

// "axis.link.weights.junction.beyond" and all other weights belong together.
std::string group_of(const std::string& name) {
  constexpr std::string_view weights = "axis.link.weights";
  return name.starts_with(weights) ? std::string(weights) : name;
}

}  // namespace

std::vector<Parameter> tunable_parameters(Method method) {
  std::vector<Parameter> parameters = declared_parameters();
  std::erase_if(parameters, [&](const Parameter& parameter) {
    return !parameter.range || !parameter.name.starts_with(name_of(method) + '.');
  });
  return parameters;
}

double value_at(const Parameter& parameter, double place) {
  const auto& [least, greatest, by_factors] = *parameter.range;
  const double part = std::clamp(place, 0.0, 1.0);
  const double value =
      by_factors ? least * std::pow(greatest / least, part) : least + part * (greatest - least);
  return parameter.is_whole ? std::round(value) : rounded_to_digits(value);
}

double place_of(const Parameter& parameter, double value) {
  const auto& [least, greatest, by_factors] = *parameter.range;
  const double inside = std::clamp(value, least, greatest);
  return by_factors ? std::log(inside / least) / std::log(greatest / least)
                    : (inside - least) / (greatest - least);
}

std::vector<Sensitivity> sensitivities(const Race& race, const std::vector<Parameter>& parameters,
                                       double step, Look look) {
  std::vector<Sensitivity> seen;
  seen.reserve(parameters.size());
  for (const Parameter& parameter : parameters) {
    const double down = race.advantage(moved(race.best(), parameter, -step), look);
    const double up = race.advantage(moved(race.best(), parameter, step), look);
    seen.push_back({parameter.name, down, up});
  }
  return seen;
}

void tune(Race& race, const std::vector<Parameter>& parameters,
          const std::function<void(const std::vector<Sensitivity>&)>& looked) {
  constexpr double first_step = 0.2;
  constexpr double last_step = 0.05;
  constexpr std::size_t most_looked_at = 16;
  constexpr std::size_t most_searched = 8;
  for (double step = first_step; step >= last_step; step /= 2) {
    const std::vector<Sensitivity> seen = sensitivities(race, parameters, step, Look::glance);
    if (step == first_step) looked(seen);
    try_moves_that_help(race, parameters, seen, step);
    const std::vector<Parameter> first = those_that_matter(parameters, seen, most_looked_at);
    const std::vector<Sensitivity> closer = sensitivities(race, first, step, Look::heat);
    if (step == first_step) looked(with_closer(seen, closer));
    try_moves_that_help(race, first, closer, step);
    const std::vector<Parameter> searched = those_that_matter(first, closer, most_searched);
    if (!searched.empty()) search_together(race, searched, step);
  }
}

std::set<std::string> groups_of_differences(const Parameters& one, const Parameters& other) {
  std::vector<Parameters::value_type> differences;
  std::ranges::set_symmetric_difference(one, other, std::back_inserter(differences));
  std::set<std::string> groups;
  for (const auto& [name, value] : differences) groups.insert(group_of(name));
  return groups;
}

void keep_what_helps(Race& race, const Parameters& start) {
  for (const std::string& group : groups_of_differences(race.best(), start)) {
    const auto is_in_group = [&](const auto& parameter) { return group_of(parameter.first) == group; };
    Parameters without = race.best();
    std::erase_if(without, is_in_group);
    std::ranges::copy_if(start, std::inserter(without, without.end()), is_in_group);
    race.take_if_as_good(without);
  }
}

}  // namespace tanglebin
