#pragma once

#include <iosfwd>

#include "tanglebin/scene/scene.hpp"

namespace tanglebin {

/// Writes a valid scene as a scene file that read_scene() reads back as the same, number for number.
void write_scene(std::ostream& out, const Scene& scene);

}  // namespace tanglebin
