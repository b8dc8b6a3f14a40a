#include "tanglebin/model/parameters.hpp"

#include <fmt/core.h>

#include <cmath>
#include <concepts>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/suggestion.hpp"
#include "tanglebin/base/text.hpp"

namespace tanglebin {
namespace {

constexpr std::string_view weights = "axis.link.weights.";

std::string name_of_weight(LinkKind kind, std::size_t feature) {
  return fmt::format("{}{}.{}", weights, name_of(kind), feature_name(kind, feature));
}

/// A parameter but for its value.
struct Declaration {
  std::string name;
  std::string_view meaning;
  Bounds bounds;
  std::optional<SearchRange> range{};
};

// What a step divides by is not 0, and no count makes it endless.
constexpr Bounds between(double least, double greatest) {
  return {least, greatest};
}

constexpr Bounds up_to(double greatest) {
  return {0, greatest};
}

constexpr Bounds share = up_to(1);
constexpr Bounds many = between(1, 1'000'000);
constexpr Bounds few = between(1, 1000);
constexpr Bounds any_weight = between(-1e6, 1e6);

SearchRange by_factors(double least, double greatest) {
  return {least, greatest, true};
}

SearchRange by_steps(double least, double greatest) {
  return {least, greatest, false};
}

// To add a parameter, add a line here.
template <typename Settings, typename Visit>
void for_each_parameter(Settings& settings, Visit visit) {
  visit({"axis.filter.margin", "m; a point nearer than this to a wall or the floor belongs to the bin",
         up_to(1), by_factors(1e-4, 0.005)},
        settings.axis.filter.margin);
  visit({"axis.filter.overhang",
         "m; points farther than this outside the bin, sideways or upwards, are dropped", up_to(100),
         by_steps(0.1, 0.6)},
        settings.axis.filter.overhang);
  visit({"axis.ramp.slope_min", "m of depth per m across the view, from each point of a ramp to the next",
         up_to(1000), by_factors(0.4, 7)},
        settings.axis.ramp.slope_min);
  visit({"axis.ramp.drop_min", "radii, of depth from end to end of a ramp; a tube's flank has less",
         up_to(100), by_factors(0.2, 3)},
        settings.axis.ramp.drop_min);
  visit({"axis.ramp.edge_min", "radii, the same for the edges that show what the scanner does", up_to(100),
         by_factors(0.4, 6)},
        settings.axis.ramp.edge_min);
  visit({"axis.ramp.pixels_min", "pixels that a tube's radius must have for ramps to be looked for",
         between(0.01, 1000), by_factors(1, 20)},
        settings.axis.ramp.pixels_min);
  visit({"axis.ramp.steps_max", "longer runs of steep steps are steep surfaces", many, by_factors(2, 24)},
        settings.axis.ramp.steps_max);
  visit({"axis.ramp.beside", "points beside a ramp that do not vote either, as a share of its length",
         up_to(100), by_steps(0, 2)},
        settings.axis.ramp.beside);
  visit({"axis.ramp.blended_min", "share of blended edges from which on the scanner is one that makes ramps",
         up_to(100), by_factors(0.01, 1)},
        settings.axis.ramp.blended_min);
  visit({"axis.vote.patch.neighbours", "desired number of points in a patch", many, by_factors(8, 160)},
        settings.axis.vote.patch.neighbours);
  visit({"axis.vote.patch.neighbours_min", "a point with fewer neighbours has no patch", many,
         by_factors(3, 20)},
        settings.axis.vote.patch.neighbours_min);
  visit(
      {"axis.vote.patch.reach_min", "radii; the reach, within which points are neighbours, is at least this",
       between(0.05, 10), by_factors(0.1, 1)},
      settings.axis.vote.patch.reach_min);
  visit({"axis.vote.patch.reach_max", "radii; and at most this", between(0.05, 10), by_factors(0.3, 2)},
        settings.axis.vote.patch.reach_max);
  visit({"axis.vote.patch.breadth_min", "reaches²; minimum variance of the neighbours across their line",
         up_to(100), by_factors(0.002, 0.2)},
        settings.axis.vote.patch.breadth_min);
  visit({"axis.vote.patch.roughness_max", "medians; maximum variance of the neighbours about their plane",
         up_to(1000), by_factors(0.5, 20)},
        settings.axis.vote.patch.roughness_max);
  visit({"axis.vote.facing_min",
         "cosine of the angle between a patch's normal and the view; where there are ramps", share,
         by_steps(0, 0.9)},
        settings.axis.vote.facing_min);
  visit({"axis.vote.floor_margin", "radii; points nearer to the floor are not on a visible tube", up_to(100),
         by_steps(0, 1.5)},
        settings.axis.vote.floor_margin);
  visit({"axis.vote.bin_tolerance", "radii, by which an axis may be nearer to the bin than one radius",
         up_to(100), by_steps(0, 1)},
        settings.axis.vote.bin_tolerance);
  visit({"axis.vote.flat_min",
         "flat places, half a radius apart, that make a surface that does not vote; not in a known bin", many,
         by_factors(5, 100)},
        settings.axis.vote.flat_min);
  visit({"axis.fragment.voxel", "radii; the axes of touching tubes are two radii apart", between(0.05, 100),
         by_factors(0.1, 1)},
        settings.axis.fragment.voxel);
  visit({"axis.fragment.step", "radii, between the nodes of a centre line", between(0.05, 100),
         by_factors(0.15, 1.5)},
        settings.axis.fragment.step);
  visit({"axis.fragment.branch_min", "radii; shorter branches of a centre line are dropped", up_to(100),
         by_factors(0.4, 6)},
        settings.axis.fragment.branch_min);
  visit({"axis.fragment.end_length", "radii, length of the part that gives an end its direction", up_to(100),
         by_factors(0.4, 6)},
        settings.axis.fragment.end_length);
  visit({"axis.fragment.spot_max", "radii; votes with a smaller standard deviation count as a single spot",
         up_to(100), by_factors(0.02, 0.6)},
        settings.axis.fragment.spot_max);
  visit({"axis.fragment.cap_min", "least eigenvalue of the mean of n nᵀ over the normals n of a cap",
         up_to(100), by_factors(0.005, 0.5)},
        settings.axis.fragment.cap_min);
  visit({"axis.fragment.extent_min", "radii, from the last node of a centre line to its end", up_to(100),
         by_factors(0.005, 0.4)},
        settings.axis.fragment.extent_min);
  visit({"axis.fragment.spread_max", "radii, from the votes to their centre line", up_to(100),
         by_factors(0.1, 2)},
        settings.axis.fragment.spread_max);
  visit(
      {"axis.fragment.share_min", "share of the votes that must be this near to it", share, by_steps(0.3, 1)},
      settings.axis.fragment.share_min);
  visit({"axis.fragment.weak_max", "medians; voxels with fewer votes connect nothing, where there are ramps",
         up_to(100), by_factors(0.01, 1)},
        settings.axis.fragment.weak_max);
  visit({"axis.fragment.parallel_max", "length of the mean normal of a voxel; more are on a plane", share,
         by_steps(0.8, 1)},
        settings.axis.fragment.parallel_max);
  visit({"axis.fragment.points_min", "fragments with fewer points are dropped", many, by_factors(2, 40)},
        settings.axis.fragment.points_min);
  visit({"axis.fragment.speck_max", "and those with less than this share of the points on a radius of length",
         up_to(100), by_factors(0.01, 1)},
        settings.axis.fragment.speck_max);
  visit({"axis.fragment.noisy_min", "radii, of the usual residual; with less, votes are not cut again",
         up_to(100), by_factors(0.001, 1)},
        settings.axis.fragment.noisy_min);
  visit(
      {"axis.fragment.sure_min", "share of points probably right; with more, neither", share, by_steps(0, 1)},
      settings.axis.fragment.sure_min);
  visit({"axis.link.angle_max", "rad, α", up_to(100), by_steps(0.8, 6.3)}, settings.axis.link.angle_max);
  visit({"axis.link.length_tolerance", "how much longer than known a tube may be, as a fraction", up_to(100),
         by_factors(0.005, 0.2)},
        settings.axis.link.length_tolerance);
  visit({"axis.link.ends_tolerance", "surplus ends that a tree may have, where noise made a branch", few,
         by_steps(1, 4)},
        settings.axis.link.ends_tolerance);
  visit({"axis.link.beyond_max", "radii, from a fragment's end to a hidden junction", up_to(100),
         by_factors(0.8, 13)},
        settings.axis.link.beyond_max);
  visit({"axis.link.seen_empty_max", "fraction of the gap between two ends that may be seen to be empty",
         share, by_steps(0, 1)},
        settings.axis.link.seen_empty_max);
  visit({"axis.link.chain_prior",
         "log odds; added because a fragment is more often part of a tube than a whole one", up_to(1000),
         by_steps(0, 32)},
        settings.axis.link.chain_prior);
  visit({"axis.link.tree_prior", "the same, between ends of trees", up_to(1000), by_steps(0, 24)},
        settings.axis.link.tree_prior);
  visit({"axis.link.junction_prior", "the same, between an end and a junction", up_to(1000), by_steps(0, 24)},
        settings.axis.link.junction_prior);
  visit({"axis.link.misfit_unit", "radii of misfit with the known tree that cost one unit of log odds",
         between(0.01, 1000), by_factors(0.2, 4)},
        settings.axis.link.misfit_unit);
  visit({"axis.link.missing_unit", "radii of missing length that cost one unit of log odds",
         between(0.01, 1000), by_factors(0.8, 20)},
        settings.axis.link.missing_unit);
  visit({"axis.link.unseen_unit", "the same for what a chain lacks though it should have been seen",
         between(0.01, 1000), by_factors(0.2, 5)},
        settings.axis.link.unseen_unit);
  visit({"axis.link.hidden_stretch", "a hidden way may be longer by this factor than it looks", up_to(1000),
         by_steps(1, 6)},
        settings.axis.link.hidden_stretch);
  visit({"axis.link.strangeness_max",
         "how unlike the whole chains of the scan a chain may be, as a multiple of how unlike they are to "
         "each other",
         up_to(1000), by_factors(0.5, 8)},
        settings.axis.link.strangeness_max);
  visit({"axis.link.strangeness_weight", "log odds that a unit above it costs", up_to(1000), by_steps(0, 16)},
        settings.axis.link.strangeness_weight);
  visit({"axis.link.bent_weight", "the same where the whole chains of the scan are bent", up_to(1000),
         by_steps(0, 32)},
        settings.axis.link.bent_weight);
  visit({"axis.link.bent_empty", "log odds that a radius of a bent chain costs that was seen to be empty",
         up_to(1000), by_steps(0, 16)},
        settings.axis.link.bent_empty);
  visit({"axis.link.bent_angles",
         "share of the weights of angles that counts where the whole chains of the scan are bent", share,
         by_steps(0, 1)},
        settings.axis.link.bent_angles);
  for (const LinkKind kind : link_kinds) {
    for (std::size_t i = 0; i < link_features; ++i)
      visit({name_of_weight(kind, i), "log odds per unit of this feature of a link", any_weight},
            settings.axis.link.weights.of(kind)[i]);
  }
  visit({"axis.fit.tolerance", "radii; tolerance for simplifying a centre line before the fit",
         between(0.001, 100), by_factors(0.02, 0.4)},
        settings.axis.fit.tolerance);
  visit({"axis.fit.residual_max", "radii; points farther from the surface are ignored", between(0.001, 100),
         by_factors(0.1, 1)},
        settings.axis.fit.residual_max);
  visit({"axis.fit.points_max", "maximum number of points that a tube is fitted to", many,
         by_factors(100, 3000)},
        settings.axis.fit.points_max);
  visit({"axis.fit.iterations", "Gauss-Newton steps", few, by_factors(1, 16)}, settings.axis.fit.iterations);
  visit({"axis.label.distance_max", "radii, from a point to the surface of its tube", up_to(100),
         by_factors(0.2, 5)},
        settings.axis.label.distance_max);
  visit({"paper.filter.margin", "m; a point nearer than this to a wall or the floor belongs to the bin",
         up_to(1), by_factors(1e-4, 0.005)},
        settings.paper.filter.margin);
  visit({"paper.filter.overhang",
         "m; points farther than this outside the bin, sideways or upwards, are dropped", up_to(100),
         by_steps(0.1, 0.6)},
        settings.paper.filter.overhang);
  visit({"paper.normal_neighbours", "nearest points that a normal is estimated from", between(3, 1000),
         by_factors(4, 60)},
        settings.paper.normal_neighbours);
  visit({"paper.segment.neighbours", "nearest points that a region may grow to", few, by_factors(4, 60)},
        settings.paper.segment.neighbours);
  visit({"paper.segment.angle_max", "rad, between the normals of neighbouring points in a region", up_to(100),
         by_factors(0.05, 1.5)},
        settings.paper.segment.angle_max);
  visit(
      {"paper.segment.curvature_max", "surface variation; regions do not grow beyond points above it (edges)",
       up_to(1), by_factors(0.01, 0.3)},
      settings.paper.segment.curvature_max);
  visit({"paper.segment.points_min", "smaller regions are dropped", many, by_factors(3, 60)},
        settings.paper.segment.points_min);
  visit({"paper.fit.distance_max", "m, for a cylinder's inliers, with the error of the normal weighted in",
         up_to(1), by_factors(2e-4, 0.01)},
        settings.paper.fit.distance_max);
  visit({"paper.fit.normal_weight", "weight of the normal in that distance, per radian", share,
         by_factors(0.002, 0.2)},
        settings.paper.fit.normal_weight);
  visit({"paper.fit.radius_tolerance", "relative to the known radius", share, by_factors(0.03, 0.9)},
        settings.paper.fit.radius_tolerance);
  visit(
      {"paper.fit.sample_distance", "m, largest distance between the two points that define a trial cylinder",
       up_to(1), by_factors(0.005, 0.3)},
      settings.paper.fit.sample_distance);
  visit({"paper.fit.iterations_max", "trials for one cylinder", few, by_factors(30, 1000)},
        settings.paper.fit.iterations_max);
  visit({"paper.fit.points_min", "inliers of a cylinder", many, by_factors(4, 60)},
        settings.paper.fit.points_min);
  visit({"paper.fit.gap_max", "m, along the axis; inliers beyond a longer gap belong to another cylinder",
         up_to(1), by_factors(0.003, 0.15)},
        settings.paper.fit.gap_max);
  visit({"paper.fit.claim_distance", "m; points this near to a cylinder's surface are not fitted again",
         up_to(1), by_factors(0.001, 0.03)},
        settings.paper.fit.claim_distance);
  visit({"paper.fit.length_min", "m, after trimming; shorter pieces have no reliable direction",
         between(1e-4, 1), by_factors(5e-4, 0.04)},
        settings.paper.fit.length_min);
  visit({"paper.fit.trim", "m, cut off each end, which reaches into the bend", up_to(1),
         by_factors(4e-4, 0.02)},
        settings.paper.fit.trim);
  visit({"paper.join.distance_max", "m, between two ends", up_to(100), by_factors(0.05, 1.5)},
        settings.paper.join.distance_max);
  visit({"paper.join.angle_max", "rad, the angles of both cylinders with the gap between them",
         between(0.01, 100), by_steps(0.5, 6.3)},
        settings.paper.join.angle_max);
  visit({"paper.join.hidden_radius", "pixels around the middle of the gap in which an occluder counts", few,
         by_factors(1, 40)},
        settings.paper.join.hidden_radius);
  visit({"paper.join.length_tolerance", "how much longer than known a tube may be, as a fraction", up_to(100),
         by_factors(0.01, 0.5)},
        settings.paper.join.length_tolerance);
  visit({"paper.label.distance_max", "radii, from a point to the surface of its tube", up_to(100),
         by_factors(0.1, 3)},
        settings.paper.label.distance_max);
}

constexpr std::string_view list_of_parameters = "docs/algorithm.md";

template <typename Value>
void set(Value& parameter, double value, const Declaration& of) {
  const auto& [least, greatest] = of.bounds;
  const bool is_of_its_kind = std::floating_point<Value> || value == std::floor(value);
  if (!(value >= least && value <= greatest && is_of_its_kind))
    throw InputError({"", 0, of.name}, fmt::format("{}", value),
                     fmt::format("a {} from {} to {}", std::floating_point<Value> ? "number" : "whole number",
                                 least, greatest));
  parameter = static_cast<Value>(value);
}

[[noreturn]] void reject(std::string_view name, const std::map<std::string, double>& known) {
  std::vector<std::string_view> names;
  names.reserve(known.size());
  for (const auto& [known_name, value] : known) names.push_back(known_name);
  reject_name(name, names, fmt::format("a parameter listed in {}", list_of_parameters));
}

}  // namespace

std::map<std::string, double> parameters(const ModelSettings& settings) {
  std::map<std::string, double> values;
  for_each_parameter(settings, [&](const Declaration& of, auto value) { values.emplace(of.name, value); });
  return values;
}

std::vector<Parameter> declared_parameters() {
  std::vector<Parameter> all;
  const ModelSettings defaults;
  for_each_parameter(defaults, [&](const Declaration& of, auto value) {
    all.push_back({of.name, std::string(of.meaning), static_cast<double>(value),
                   std::is_integral_v<decltype(value)>, of.bounds, of.range});
  });
  return all;
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
  for_each_parameter(settings, [&](const Declaration& known, auto& parameter) {
    if (name != known.name) return;
    is_known = true;
    set(parameter, value, known);
  });
  if (!is_known) reject(name, parameters(settings));
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
