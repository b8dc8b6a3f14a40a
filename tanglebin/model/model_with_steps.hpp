#pragma once

#include <functional>
#include <variant>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/axis/axis_method.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/model/paper/paper_method.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"
#include "tanglebin/model/scene/support_frame.hpp"

namespace tanglebin {

/// The results of a method's steps, in the support's frame.
using MethodSteps = std::variant<PaperModel, AxisModel>;

/// Runs the method of the settings, which must be valid, on a scan in the support's frame. `at_step` is
/// called after each step.
MethodSteps steps_of(const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings,
                     const std::function<void()>& at_step);

/// The model that the steps made, in the support's frame.
Model& model_of(MethodSteps& steps);

/// A model, and how the method came to it.
struct ModelWithSteps {
  Model model{};        ///< in the world frame
  Seen seen{};          ///< what the method worked on, in the support's frame
  MethodSteps steps{};  ///< in the support's frame
};

/// The same as model_tubes(), with the results of the steps, for which it copies the cloud's points and the
/// model.
ModelWithSteps model_with_steps(
    const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings = {},
    const std::function<void()>& at_step = [] {});

}  // namespace tanglebin
