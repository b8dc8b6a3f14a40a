#pragma once

#include <string>

#include "tanglebin/model/scene/model.hpp"

namespace tanglebin {

/// The tubes of a model with their evidence, the counts of points and the findings, as the JSON of tubes.json
/// (docs/formats.md): one line without a line end. Numbers have the fewest digits that read back as the same
/// double.
std::string tubes_json(const Model& model);

}  // namespace tanglebin
