#include "tanglebin/model/model_with_steps.hpp"

#include "tanglebin/model/diagnose.hpp"
#include "tanglebin/model/point_counts.hpp"

namespace tanglebin {
namespace {

const FilterSettings& filter_of(const ModelSettings& settings) {
  return settings.method == Method::paper ? settings.paper.filter : settings.axis.filter;
}

MethodSteps run_method(const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings,
                       const std::function<void()>& at_step) {
  const auto& [method, ratio, seed, axis, paper] = settings;
  if (method == Method::paper) return model_as_in_paper(cloud, known, ratio, seed, paper, at_step);
  return model_by_axes(cloud, known, ratio, seed, axis, at_step);
}

}  // namespace

MethodSteps steps_of(const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings,
                     const std::function<void()>& at_step) {
  MethodSteps steps = run_method(cloud, known, settings, at_step);
  count_points(model_of(steps), cloud, known, filter_of(settings));
  return steps;
}

Model& model_of(MethodSteps& steps) {
  return std::visit([](auto& of_method) -> Model& { return of_method.model; }, steps);
}

ModelWithSteps model_with_steps(const PointCloud& cloud, const KnownScene& known,
                                const ModelSettings& settings, const std::function<void()>& at_step) {
  validate(known, settings);
  ModelWithSteps result{.seen = in_support_frame(cloud, known)};
  result.steps = steps_of(result.seen.cloud, result.seen.known, settings, at_step);
  result.model = in_world_frame(model_of(result.steps), known);
  result.model.findings = diagnose(cloud, known, result.model, settings.ratio);
  return result;
}

}  // namespace tanglebin
