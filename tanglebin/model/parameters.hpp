#pragma once

#include <map>
#include <string>
#include <string_view>

#include "tanglebin/model/model_tubes.hpp"

namespace tanglebin {

/// The parameters of both methods by their names, which are those of the members: "axis.vote.floor_margin".
std::map<std::string, double> parameters(const ModelSettings& settings);

/// Those of the parameters that differ from the defaults.
std::map<std::string, double> changed_parameters(const ModelSettings& settings);

/// Sets the parameter of an assignment such as "axis.vote.floor_margin=0.4". Throws InputError naming
/// `option` for an unknown name, and for a value that is not a number of the parameter's kind: finite and not
/// negative, whole and positive for a count.
void set_parameter(ModelSettings& settings, std::string_view assignment, const std::string& option);

}  // namespace tanglebin
