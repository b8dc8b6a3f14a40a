#include "tanglebin/model/scene/known_scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/millimetres.hpp"

namespace tanglebin {
namespace {

void check_positive(double value, const std::string& field) {
  if (!std::isfinite(value) || value <= 0) {
    throw InputError({"", 0, field}, fmt::format("{}", value), "a positive number");
  }
}

// Keeps the indices of grids with tube-wide cells in range.
void validate_radius(double radius) {
  check_positive(radius, "radius");
  constexpr double thinnest = 1e-4;
  constexpr double thickest = 1;
  if (radius < thinnest || radius > thickest)
    throw InputError({"", 0, "radius"}, fmt::format("{} m", radius),
                     fmt::format("{} to {} m{}", thinnest, thickest, hint_of_millimetres(radius)));
}

// Larger numbers are not in metres. A tube may be longer than the bin, but not many times.
void validate_fit(const TubeKind& kind, const Bin& bin) {
  const double widest = std::min(bin.length, bin.width) / 2;
  if (kind.radius >= widest)
    throw InputError({"", 0, "radius"}, fmt::format("{} m", kind.radius),
                     fmt::format("less than {:.4g} m, half the bin's narrower side{}", widest,
                                 hint_of_millimetres(kind.radius)));
  constexpr double too_many_times = 10;
  const double longest = too_many_times * Eigen::Vector3d(bin.length, bin.width, bin.height).norm();
  if (kind.length_is_known() && kind.length() > longest)
    throw InputError({"", 0, kind.branches() ? "tree" : "length"}, fmt::format("{} m", kind.length()),
                     fmt::format("at most {:.3g} m, ten times the bin's diagonal{}", longest,
                                 hint_of_millimetres(kind.length())));
}

void validate_length_min(const TubeKind& kind) {
  if (!(kind.length_min >= 0 && kind.length_min <= kind.length()))
    throw InputError({"", 0, "length_min"}, fmt::format("{} m", kind.length_min),
                     fmt::format("0 if it is not known, or at most the length of {} m", kind.length()));
}

}  // namespace

void validate(const KnownScene& known) {
  validate(known.support);
  validate(known.camera);
  if (known.kinds.empty()) throw InputError({"", 0, "kinds"}, "none", "at least one kind of tube");
  std::set<double> radii;
  for (const TubeKind& kind : known.kinds) {
    validate_radius(kind.radius);
    if (kind.branches() || !std::isinf(kind.length()))
      validate(kind.segments, kind.branches() ? "tree" : "length");
    validate_length_min(kind);
    if (known.support.shape == Support::Shape::bin) validate_fit(kind, known.support.bin);
    if (!radii.insert(kind.radius).second)
      throw InputError({"", 0, "radius"}, fmt::format("{} m for two kinds", kind.radius),
                       "a different radius for each kind; tubes of several lengths are one kind, with the "
                       "range of its lengths: length = { min, max }");
  }
}

}  // namespace tanglebin
