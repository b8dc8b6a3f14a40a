#include "tanglebin/model/model.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "tanglebin/base/error.hpp"
#include "tanglebin/model/axis_method.hpp"
#include "tanglebin/model/paper_method.hpp"

namespace tanglebin {
namespace {

void check_positive(double value, const std::string& field) {
  if (!std::isfinite(value) || value <= 0) {
    throw InputError({"", 0, field}, fmt::format("{}", value), "a positive number");
  }
}

// A cloud many times larger than the scene is not in metres.
void check_size(const PointCloud& cloud, const KnownScene& known, const std::string& name) {
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& point : cloud.points) {
    if (point.allFinite()) bounds.extend(point);
  }
  if (bounds.isEmpty()) return;
  const double size = bounds.sizes().cast<double>().maxCoeff();
  constexpr double too_many_times = 100;
  if (size > too_many_times * known.bin.length) {
    throw InputError({name, 0, ""}, fmt::format("points up to {:.4g} m apart", size),
                     fmt::format("a scan, in metres, of a bin that is {:.4g} m long; are these millimetres?",
                                 known.bin.length));
  }
}

}  // namespace

void validate(const KnownScene& known) {
  validate(known.bin);
  validate(known.camera);
  if (known.kinds.empty()) throw InputError({"", 0, "kinds"}, "none", "at least one kind of tubes");
  std::set<double> radii;
  for (const TubeKind& kind : known.kinds) {
    check_positive(kind.radius, "radius");
    validate(kind.segments, kind.branches() ? "tree" : "length");
    // Grids of cells as wide as a tube have no more cells than their indices can count.
    constexpr double thinnest = 1e-5;  // of the bin's length
    if (kind.radius < thinnest * known.bin.length)
      throw InputError({"", 0, "radius"}, fmt::format("{} m", kind.radius),
                       fmt::format("at least {:.4g} m, for a bin that is {} m long",
                                   thinnest * known.bin.length, known.bin.length));
    if (!radii.insert(kind.radius).second)
      throw InputError({"", 0, "radius"}, fmt::format("{} m a second time", kind.radius),
                       "kinds of tubes whose radii differ");
  }
}

std::vector<Method> methods() {
  return {Method::paper, Method::axis};
}

std::string name_of(Method method) {
  switch (method) {
    case Method::paper:
      return "paper";
    case Method::axis:
      return "axis";
  }
  return {};
}

Method method_named(const std::string& name) {
  std::string names;
  for (const Method method : methods()) {
    if (name_of(method) == name) return method;
    names += (names.empty() ? "" : ", ") + name_of(method);
  }
  throw InputError({"", 0, "method"}, "\"" + name + "\"", names);
}

Model model_tubes(const PointCloud& cloud, const KnownScene& known, Method method, double ratio,
                  std::uint64_t seed, const std::string& name) {
  validate(known);
  if (!(ratio > 0 && ratio <= 1)) {
    throw InputError({"", 0, "downsample"}, fmt::format("{}", ratio), "a ratio above 0, at most 1");
  }
  check_size(cloud, known, name);
  switch (method) {
    case Method::paper:
      if (known.kinds.size() > 1)
        throw InputError({"", 0, "method"}, "paper, for tubes of several radii",
                         "axis: the paper's knows one radius");
      return model_as_in_paper(cloud, known, ratio, seed).model;
    case Method::axis:
      return model_by_axes(cloud, known, ratio, seed).model;
  }
  return {};
}

}  // namespace tanglebin
