#include "tanglebin/model/model_tubes.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/model/axis/axis_method.hpp"
#include "tanglebin/model/paper/paper_method.hpp"
#include "tanglebin/model/scene/support_frame.hpp"

namespace tanglebin {
namespace {

// A cloud many times larger than the scene is not in metres.
void check_size(const PointCloud& cloud, const KnownScene& known) {
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& point : cloud.points) {
    if (point.allFinite()) bounds.extend(point);
  }
  if (bounds.isEmpty()) return;
  const double size = bounds.sizes().cast<double>().maxCoeff();
  constexpr double too_many_times = 100;
  if (known.support.shape == Support::Shape::bin && size > too_many_times * known.support.bin.length) {
    throw InputError({}, fmt::format("points up to {:.4g} m apart", size),
                     fmt::format("a scan, in metres, of a bin that is {:.4g} m long; are these millimetres?",
                                 known.support.bin.length));
  }
}

}  // namespace

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
  throw InputError({"", 0, "method"}, excerpt(name), names);
}

void expect_available(Method method) {
  if (method == Method::paper) expect_paper_method();
}

void validate(const KnownScene& known, const ModelSettings& settings) {
  validate(known);
  expect_available(settings.method);
  if (!(settings.ratio > 0 && settings.ratio <= 1)) {
    throw InputError({"", 0, "downsample"}, fmt::format("{}", settings.ratio),
                     "a ratio above 0 and at most 1");
  }
  if (settings.method == Method::paper && known.kinds.size() > 1)
    throw InputError({"", 0, "method"}, "the paper's method handles a single radius; use --method axis");
}

Model model_tubes(const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings) {
  validate(known, settings);
  check_size(cloud, known);
  const auto model_here = [&](const PointCloud& here, const KnownScene& known_here) {
    const auto& [method, ratio, seed, axis, paper] = settings;
    return method == Method::paper ? model_as_in_paper(here, known_here, ratio, seed, paper).model
                                   : model_by_axes(here, known_here, ratio, seed, axis).model;
  };
  if (is_in_support_frame(known)) return model_here(cloud, known);
  const Seen seen = in_support_frame(cloud, known);
  return in_world_frame(model_here(seen.cloud, seen.known), known);
}

}  // namespace tanglebin
