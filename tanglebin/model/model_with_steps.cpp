#include "tanglebin/model/model_with_steps.hpp"

#include <utility>

#include "tanglebin/model/diagnose.hpp"
#include "tanglebin/model/point_counts.hpp"

namespace tanglebin {
namespace {

MethodSteps steps_on(const Seen& seen, const ModelSettings& settings, const std::function<void()>& at_step) {
  const auto& [cloud, known] = seen;
  const auto& [method, ratio, seed, axis, paper] = settings;
  if (method == Method::paper) return model_as_in_paper(cloud, known, ratio, seed, paper, at_step);
  return model_by_axes(cloud, known, ratio, seed, axis, at_step);
}

const FilterSettings& filter_of(const ModelSettings& settings) {
  return settings.method == Method::paper ? settings.paper.filter : settings.axis.filter;
}

}  // namespace

ModelWithSteps model_with_steps(const PointCloud& cloud, const KnownScene& known,
                                const ModelSettings& settings, const std::function<void()>& at_step) {
  validate(known, settings);
  const bool is_here = is_in_support_frame(known);
  ModelWithSteps result{.seen = is_here ? Seen{cloud, known} : in_support_frame(cloud, known)};
  result.steps = steps_on(result.seen, settings, at_step);
  result.model = std::visit([](const auto& steps) { return steps.model; }, result.steps);
  count_points(result.model, result.seen.cloud, result.seen.known, filter_of(settings));
  if (!is_here) result.model = in_world_frame(std::move(result.model), known);
  result.model.findings = diagnose(cloud, known, result.model, settings.ratio);
  return result;
}

}  // namespace tanglebin
