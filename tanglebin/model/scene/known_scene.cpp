#include "tanglebin/model/scene/known_scene.hpp"

#include <fmt/core.h>

#include <cmath>
#include <set>
#include <string>

#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

void check_positive(double value, const std::string& field) {
  if (!std::isfinite(value) || value <= 0) {
    throw InputError({"", 0, field}, fmt::format("{}", value), "a positive number");
  }
}

}  // namespace

void validate(const KnownScene& known) {
  validate(known.bin);
  validate(known.camera);
  if (known.kinds.empty()) throw InputError({"", 0, "kinds"}, "none", "at least one kind of tube");
  std::set<double> radii;
  for (const TubeKind& kind : known.kinds) {
    check_positive(kind.radius, "radius");
    validate(kind.segments, kind.branches() ? "tree" : "length");
    // Keeps the cell indices of grids with tube-wide cells in range.
    constexpr double thinnest = 1e-5;  // relative to the bin's length
    if (kind.radius < thinnest * known.bin.length)
      throw InputError({"", 0, "radius"}, fmt::format("{} m", kind.radius),
                       fmt::format("at least {:.4g} m, for a bin that is {} m long",
                                   thinnest * known.bin.length, known.bin.length));
    if (!radii.insert(kind.radius).second)
      throw InputError({"", 0, "radius"}, fmt::format("{} m for two kinds", kind.radius),
                       "a different radius for each kind");
  }
}

}  // namespace tanglebin
