#include "tanglebin/model/scene/known_scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
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

void validate_radius(double radius, const std::string& field) {
  check_positive(radius, field);
  if (radius < thinnest_radius || radius > thickest_radius)
    throw InputError({"", 0, field}, fmt::format("{} m", radius),
                     fmt::format("{} to {} m{}", thinnest_radius, thickest_radius,
                                 hint_of_millimetres(radius, thickest_radius)));
}

// Larger numbers are not in metres. A tube may be longer than the bin, but not many times.
void validate_fit(const TubeKind& kind, const Bin& bin, const std::string& where) {
  const double widest = std::min(bin.length, bin.width) / 2;
  if (kind.radius >= widest)
    throw InputError({"", 0, where + ".radius"}, fmt::format("{} m", kind.radius),
                     fmt::format("less than {:.4g} m, half the bin's narrower side{}", widest,
                                 hint_of_millimetres(kind.radius, widest)));
  constexpr double too_many_times = 10;
  const double longest = too_many_times * Eigen::Vector3d(bin.length, bin.width, bin.height).norm();
  if (kind.length_is_known() && kind.length() > longest)
    throw InputError({"", 0, where + '.' + field_of_length(kind)}, fmt::format("{} m", kind.length()),
                     fmt::format("at most {:.3g} m, ten times the bin's diagonal{}", longest,
                                 hint_of_millimetres(kind.length(), longest)));
}

void validate_length_min(const TubeKind& kind, const std::string& where) {
  if (!(kind.length_min >= 0 && kind.length_min <= kind.length()))
    throw InputError({"", 0, where + ".length_min"}, fmt::format("{} m", kind.length_min),
                     fmt::format("0 if it is not known, or at most the length of {} m", kind.length()));
}

// A kind's path, as in TOML: kinds[0].
std::string path_in(const std::string& list, std::size_t index) {
  return fmt::format("{}[{}]", list, index);
}

void validate_alone(const TubeKind& kind, const std::string& where) {
  validate_radius(kind.radius, where + ".radius");
  if (kind.branches() || kind.length_is_known()) validate(kind.segments, where + '.' + field_of_length(kind));
  validate_length_min(kind, where);
}

}  // namespace

std::string field_of_length(const TubeKind& kind) {
  return kind.branches() ? "segment" : "length";
}

void validate_together(const std::vector<TubeKind>& kinds, const Support& support, const std::string& list) {
  std::set<double> radii;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const TubeKind& kind = kinds[i];
    if (support.shape == Support::Shape::bin) validate_fit(kind, support.bin, path_in(list, i));
    if (kind.radius > 0 && !radii.insert(kind.radius).second)
      throw InputError({"", 0, path_in(list, i) + ".radius"}, fmt::format("{} m for two kinds", kind.radius),
                       "a different radius for each kind; tubes of several lengths are one kind, with the "
                       "range of its lengths: length = { min, max }");
  }
}

void validate(const KnownScene& known) {
  validate(known.support);
  validate(known.camera);
  if (known.kinds.empty()) throw InputError({"", 0, "kinds"}, "none", "at least one kind of tube");
  const std::string list = "kinds";
  for (std::size_t i = 0; i < known.kinds.size(); ++i) validate_alone(known.kinds[i], path_in(list, i));
  validate_together(known.kinds, known.support, list);
}

}  // namespace tanglebin
