#include "tanglebin/model/parameters.hpp"

#include <fmt/core.h>

#include <cmath>
#include <concepts>
#include <limits>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {
namespace {

constexpr std::string_view weights = "axis.link.weights.";

std::string name_of_weight(LinkKind kind, std::size_t feature) {
  return fmt::format("{}{}.{}", weights, name_of(kind), feature_name(kind, feature));
}

// To add a parameter, add a line here.
template <typename Settings, typename Visit>
void for_each_parameter(Settings& settings, Visit visit) {
  visit("axis.filter.margin", settings.axis.filter.margin);
  visit("axis.filter.overhang", settings.axis.filter.overhang);
  visit("axis.ramp.slope_min", settings.axis.ramp.slope_min);
  visit("axis.ramp.drop_min", settings.axis.ramp.drop_min);
  visit("axis.ramp.edge_min", settings.axis.ramp.edge_min);
  visit("axis.ramp.pixels_min", settings.axis.ramp.pixels_min);
  visit("axis.ramp.steps_max", settings.axis.ramp.steps_max);
  visit("axis.ramp.beside", settings.axis.ramp.beside);
  visit("axis.ramp.blended_min", settings.axis.ramp.blended_min);
  visit("axis.vote.patch.neighbours", settings.axis.vote.patch.neighbours);
  visit("axis.vote.patch.neighbours_min", settings.axis.vote.patch.neighbours_min);
  visit("axis.vote.patch.reach_min", settings.axis.vote.patch.reach_min);
  visit("axis.vote.patch.reach_max", settings.axis.vote.patch.reach_max);
  visit("axis.vote.patch.breadth_min", settings.axis.vote.patch.breadth_min);
  visit("axis.vote.patch.roughness_max", settings.axis.vote.patch.roughness_max);
  visit("axis.vote.facing_min", settings.axis.vote.facing_min);
  visit("axis.vote.floor_margin", settings.axis.vote.floor_margin);
  visit("axis.vote.bin_tolerance", settings.axis.vote.bin_tolerance);
  visit("axis.fragment.voxel", settings.axis.fragment.voxel);
  visit("axis.fragment.step", settings.axis.fragment.step);
  visit("axis.fragment.branch_min", settings.axis.fragment.branch_min);
  visit("axis.fragment.end_length", settings.axis.fragment.end_length);
  visit("axis.fragment.spot_max", settings.axis.fragment.spot_max);
  visit("axis.fragment.cap_min", settings.axis.fragment.cap_min);
  visit("axis.fragment.extent_min", settings.axis.fragment.extent_min);
  visit("axis.fragment.spread_max", settings.axis.fragment.spread_max);
  visit("axis.fragment.share_min", settings.axis.fragment.share_min);
  visit("axis.fragment.weak_max", settings.axis.fragment.weak_max);
  visit("axis.fragment.parallel_max", settings.axis.fragment.parallel_max);
  visit("axis.fragment.points_min", settings.axis.fragment.points_min);
  visit("axis.fragment.speck_max", settings.axis.fragment.speck_max);
  visit("axis.link.angle_max", settings.axis.link.angle_max);
  visit("axis.link.length_tolerance", settings.axis.link.length_tolerance);
  visit("axis.link.ends_tolerance", settings.axis.link.ends_tolerance);
  visit("axis.link.beyond_max", settings.axis.link.beyond_max);
  visit("axis.link.seen_empty_max", settings.axis.link.seen_empty_max);
  visit("axis.link.chain_prior", settings.axis.link.chain_prior);
  visit("axis.link.tree_prior", settings.axis.link.tree_prior);
  visit("axis.link.junction_prior", settings.axis.link.junction_prior);
  visit("axis.link.misfit_unit", settings.axis.link.misfit_unit);
  visit("axis.link.missing_unit", settings.axis.link.missing_unit);
  visit("axis.link.unseen_unit", settings.axis.link.unseen_unit);
  visit("axis.link.hidden_stretch", settings.axis.link.hidden_stretch);
  for (const LinkKind kind : link_kinds) {
    for (std::size_t i = 0; i < link_features; ++i)
      visit(name_of_weight(kind, i).c_str(), settings.axis.link.weights.of(kind)[i]);
  }
  visit("axis.fit.tolerance", settings.axis.fit.tolerance);
  visit("axis.fit.residual_max", settings.axis.fit.residual_max);
  visit("axis.fit.points_max", settings.axis.fit.points_max);
  visit("axis.fit.iterations", settings.axis.fit.iterations);
  visit("axis.label.distance_max", settings.axis.label.distance_max);
  visit("paper.filter.margin", settings.paper.filter.margin);
  visit("paper.filter.overhang", settings.paper.filter.overhang);
  visit("paper.normal_neighbours", settings.paper.normal_neighbours);
  visit("paper.segment.neighbours", settings.paper.segment.neighbours);
  visit("paper.segment.angle_max", settings.paper.segment.angle_max);
  visit("paper.segment.curvature_max", settings.paper.segment.curvature_max);
  visit("paper.segment.points_min", settings.paper.segment.points_min);
  visit("paper.fit.distance_max", settings.paper.fit.distance_max);
  visit("paper.fit.normal_weight", settings.paper.fit.normal_weight);
  visit("paper.fit.radius_tolerance", settings.paper.fit.radius_tolerance);
  visit("paper.fit.sample_distance", settings.paper.fit.sample_distance);
  visit("paper.fit.iterations_max", settings.paper.fit.iterations_max);
  visit("paper.fit.points_min", settings.paper.fit.points_min);
  visit("paper.fit.gap_max", settings.paper.fit.gap_max);
  visit("paper.fit.claim_distance", settings.paper.fit.claim_distance);
  visit("paper.fit.length_min", settings.paper.fit.length_min);
  visit("paper.fit.trim", settings.paper.fit.trim);
  visit("paper.join.distance_max", settings.paper.join.distance_max);
  visit("paper.join.angle_max", settings.paper.join.angle_max);
  visit("paper.join.hidden_radius", settings.paper.join.hidden_radius);
  visit("paper.join.length_tolerance", settings.paper.join.length_tolerance);
  visit("paper.label.distance_max", settings.paper.label.distance_max);
}

constexpr std::string_view list_of_parameters = "docs/algorithm.md";

void set(double& parameter, double value, bool may_be_negative, const std::string& name) {
  if (!std::isfinite(value) || (value < 0 && !may_be_negative))
    throw InputError({"", 0, name}, fmt::format("{}", value),
                     may_be_negative ? "a finite number" : "a number that is not negative");
  parameter = value;
}

template <std::integral Count>
void set(Count& parameter, double value, bool /*may_be_negative*/, const std::string& name) {
  constexpr double most = std::numeric_limits<int>::max();
  if (!(value >= 1 && value <= most && value == std::floor(value)))
    throw InputError({"", 0, name}, fmt::format("{}", value), "a whole number, 1 or more");
  parameter = static_cast<Count>(value);
}

}  // namespace

std::map<std::string, double> parameters(const ModelSettings& settings) {
  std::map<std::string, double> values;
  for_each_parameter(settings, [&](const char* name, auto value) { values.emplace(name, value); });
  return values;
}

std::map<std::string, double> changed_parameters(const ModelSettings& settings) {
  const std::map<std::string, double> defaults = parameters({});
  std::map<std::string, double> values = parameters(settings);
  std::erase_if(values,
                [&](const auto& parameter) { return defaults.at(parameter.first) == parameter.second; });
  return values;
}

void set_parameter(ModelSettings& settings, std::string_view name, double value) {
  bool is_known = false;
  for_each_parameter(settings, [&](const char* known, auto& parameter) {
    if (name != known) return;
    is_known = true;
    set(parameter, value, name.starts_with(weights), known);
  });
  if (!is_known)
    throw InputError({"", 0, ""}, excerpt(name), fmt::format("a parameter listed in {}", list_of_parameters));
}

void set_parameter(ModelSettings& settings, std::string_view assignment, const std::string& option) {
  const std::size_t middle = assignment.find('=');
  if (middle == std::string_view::npos)
    throw InputError({"", 0, option}, excerpt(assignment), "NAME=VALUE, such as axis.vote.floor_margin=0.4");
  const auto value = to_number<double>(assignment.substr(middle + 1));
  if (!value) throw InputError({"", 0, option}, excerpt(assignment.substr(middle + 1)), "a number");
  try {
    set_parameter(settings, assignment.substr(0, middle), *value);
  } catch (const InputError& error) {
    const std::string& name = error.place().field;
    throw InputError({"", 0, name.empty() ? option : option + ' ' + name}, error.problem());
  }
}

std::map<std::string, double> link_parameters(const LinkWeights& learned) {
  ModelSettings settings;
  settings.axis.link.weights = learned;
  std::map<std::string, double> values = parameters(settings);
  std::erase_if(values, [](const auto& parameter) { return !parameter.first.starts_with(weights); });
  return values;
}

}  // namespace tanglebin
