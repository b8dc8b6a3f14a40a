#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tanglebin/model/model_tubes.hpp"

namespace tanglebin {

/// The values that a parameter may have.
struct Bounds {
  double least;
  double greatest;
};

/// The values of a parameter among which `tanglebin calibrate` looks for a better one. They are within its
/// bounds.
struct SearchRange {
  double least;
  double greatest;
  bool by_factors;  ///< equal factors are equally far, as for a size; otherwise equal differences
};

/// What a parameter is.
struct Parameter {
  std::string name;
  std::string meaning;  ///< with its unit first
  double standard;      ///< its default
  bool is_whole;        ///< a count
  Bounds bounds;
  std::optional<SearchRange> range;  ///< none of the weights of links, which are learned
};

/// All parameters of both methods, in the order of their steps.
std::vector<Parameter> declared_parameters();

/// The parameters of both methods, keyed by the names of their members, such as "axis.vote.floor_margin".
std::map<std::string, double> parameters(const ModelSettings& settings);

/// The parameters that differ from their defaults.
std::map<std::string, double> changed_parameters(const ModelSettings& settings);

/// Sets a parameter. Throws InputError naming it for an unknown name and for a value outside of its
/// bounds. Counts are whole numbers.
void set_parameter(ModelSettings& settings, std::string_view name, double value);

/// The same from an assignment such as "axis.vote.floor_margin=0.4". Errors name `option` too.
void set_parameter(ModelSettings& settings, std::string_view assignment, const std::string& option);

/// Weights of links as parameters of the axis method.
std::map<std::string, double> link_parameters(const LinkWeights& learned);

}  // namespace tanglebin
