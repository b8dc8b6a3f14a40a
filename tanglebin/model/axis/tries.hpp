#pragma once

#include <cstddef>
#include <vector>

#include "tanglebin/model/axis/axis_method.hpp"
#include "tanglebin/model/axis/links/tube_shapes.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"

// Internal to the room.
namespace tanglebin {

/// How many points are expected to be on the right tube.
double probably_right(const Model& model);

/// Whether votes that are cut into other pieces may give a better model: where less than `sure_min` of the
/// points on tubes are probably right, and points are noisy: the residual of the tube that the point in the
/// middle is on is at least `noisy_min`. In a cloud of nothing but noise, they will not: where that is 0.3
/// radii or more, or most points are probably wrong.
bool is_in_doubt(const Model& model, const FragmentSettings& settings);

/// What one of the models, which has found the same length, knows of the shapes of tubes of this kind, the
/// `number`th one. Nothing is known if none does.
TubeShapes shapes_in(const std::vector<AxisModel>& tries, std::size_t number, const TubeKind& kind);

/// Of at least one model of the same cloud, the one with the most points that are probably right. A tube that
/// several models have, with the same points but for a tenth, is as sure as in the mean of these. Where at
/// least half of the models have found the same length of the tubes, or none, it is one of them: at too large
/// a length, false tubes look right. So they do where it is not known what whole tubes look like: where some
/// of the models know, it is one of these.
AxisModel& likeliest_of(std::vector<AxisModel>& tries);

/// Weighs the tubes of one of the models once more: those that others do not have are less sure. `known` with
/// the lengths that it has found.
void weigh_by_others(AxisModel& chosen, const std::vector<AxisModel>& tries, const KnownScene& known);

}  // namespace tanglebin
