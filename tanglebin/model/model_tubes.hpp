#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/axis/settings/axis_settings.hpp"
#include "tanglebin/model/paper/paper_settings.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"

namespace tanglebin {

/// The modelling methods.
enum class Method {
  paper,  ///< the paper's method (Section 4); chains only
  axis,   ///< the axis method: surface points vote for tube axes; chains and trees
};

/// All methods, in the order in which tables list them.
std::vector<Method> methods();

/// "paper" or "axis". method_named() is the inverse; it throws InputError for any other name.
std::string name_of(Method method);
Method method_named(const std::string& name);

/// Which method to use, with the parameters of both. Every parameter is a plain member; set_parameter() sets
/// one by name.
struct ModelSettings {
  Method method = Method::axis;
  double ratio = 1;        ///< downsampling ratio, 0 < ratio ≤ 1; the points are drawn at random
  std::uint64_t seed = 0;  ///< of the downsampling
  AxisSettings axis{};
  PaperSettings paper{};
};

/// Throws InputError if this build lacks the method: the paper's method needs the Point Cloud Library.
void expect_available(Method method);

/// Throws InputError if the scene or the ratio is invalid, if the method is not available, or if there are
/// several kinds of tubes and the method handles only one (paper).
void validate(const KnownScene& known, const ModelSettings& settings);

/// Models the tubes of a cloud and labels every point, including those left out by downsampling. The cloud is
/// in metres, world frame, and holds any subset of what the known camera saw, in any order; points that are
/// not finite become null, and its labels and colours are ignored. The result depends only on the arguments.
/// It says how sure each tube is, and what does not fit: is_refused() if the cloud cannot show this scene,
/// for example because it is in millimetres. Throws InputError as validate() does. The messages name no file.
/// Calls `at_step` after each step of the method, and of the paper's after each cluster; what it throws ends
/// the work.
Model model_tubes(
    const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings = {},
    const std::function<void()>& at_step = [] {});

}  // namespace tanglebin
