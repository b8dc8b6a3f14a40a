#pragma once

#include <vector>

#include "tanglebin/model/axis/axis_method.hpp"
#include "tanglebin/model/scene/model.hpp"

// Internal to the room.
namespace tanglebin {

/// How many points are expected to be on the right tube.
double probably_right(const Model& model);

/// Whether votes that are cut into other pieces may give a better model: where less than `sure_min` of the
/// points on tubes are probably right. In a cloud of noise, they will not.
bool is_in_doubt(const Model& model, double sure_min);

/// Of at least one model of the same cloud, the one with the most points that are probably right. Where at
/// least half of the models have found the same length of the tubes, or none, it is one of them: at too large
/// a length, false tubes look right.
AxisModel& likeliest_of(std::vector<AxisModel>& tries);

}  // namespace tanglebin
