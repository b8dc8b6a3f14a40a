#include "tanglebin/model/model_with_steps.hpp"

#include <optional>
#include <utility>

#include "tanglebin/model/diagnose.hpp"
#include "tanglebin/model/point_counts.hpp"
#include "tanglebin/model/scene/support_frame.hpp"

namespace tanglebin {
namespace {

using MethodSteps = std::variant<PaperModel, AxisModel>;

const FilterSettings& filter_of(const ModelSettings& settings) {
  return settings.method == Method::paper ? settings.paper.filter : settings.axis.filter;
}

MethodSteps run_method(const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings,
                       const std::function<void()>& at_step) {
  const auto& [method, ratio, seed, axis, paper] = settings;
  if (method == Method::paper) return model_as_in_paper(cloud, known, ratio, seed, paper, at_step);
  return model_by_axes(cloud, known, ratio, seed, axis, at_step);
}

Model& model_of(MethodSteps& steps) {
  return std::visit([](auto& of_method) -> Model& { return of_method.model; }, steps);
}

Model model_in_support_frame(const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings,
                             const std::function<void(const MethodRun&)>& show,
                             const std::function<void()>& at_step) {
  MethodSteps steps = run_method(cloud, known, settings, at_step);
  count_points(model_of(steps), cloud, known, filter_of(settings));
  show({cloud, known, steps});
  return std::move(model_of(steps));
}

}  // namespace

Model model_with_steps(const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings,
                       const std::function<void(const MethodRun&)>& show,
                       const std::function<void()>& at_step) {
  validate(known, settings);
  Model model;
  if (is_in_support_frame(known)) {
    model = model_in_support_frame(cloud, known, settings, show, at_step);
  } else {
    const Seen seen = in_support_frame(cloud, known);
    model = in_world_frame(model_in_support_frame(seen.cloud, seen.known, settings, show, at_step), known);
  }
  model.findings = diagnose(cloud, known, model, settings.ratio);
  return model;
}

}  // namespace tanglebin
