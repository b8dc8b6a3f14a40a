#pragma once

#include <functional>
#include <variant>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/axis/axis_method.hpp"
#include "tanglebin/model/model_tubes.hpp"
#include "tanglebin/model/paper/paper_method.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"

namespace tanglebin {

/// What a method worked on and the results of its steps, all in the support's frame.
struct MethodRun {
  const PointCloud& cloud;
  const KnownScene& known;
  const std::variant<PaperModel, AxisModel>& steps;
};

/// The same as model_tubes(), and calls `show` with the method's run before the model moves into the world
/// frame.
Model model_with_steps(
    const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings,
    const std::function<void(const MethodRun&)>& show, const std::function<void()>& at_step = [] {});

}  // namespace tanglebin
