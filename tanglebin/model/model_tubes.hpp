#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/axis/axis_settings.hpp"
#include "tanglebin/model/paper/paper_settings.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/model.hpp"

namespace tanglebin {

/// The ways to model tubes.
enum class Method {
  paper,  ///< the paper's, Section 4; for chains
  axis,   ///< by votes for the tubes' axes; for chains and trees
};

/// Every method, in the order in which tables show them.
std::vector<Method> methods();

/// "paper" or "axis". The inverse throws InputError for another name.
std::string name_of(Method method);
Method method_named(const std::string& name);

/// How tubes are modelled. Every parameter of both methods is a plain member; set_parameter() sets one by its
/// name.
struct ModelSettings {
  Method method = Method::axis;
  double ratio = 1;        ///< share of the points to model from, drawn at random; 0 < ratio ≤ 1
  std::uint64_t seed = 0;  ///< of that draw and of the method's own random choices
  AxisSettings axis{};
  PaperSettings paper{};
};

/// Throws InputError where this program lacks the method: the paper's needs the Point Cloud Library.
void expect_available(Method method);

/// Throws InputError for a scene or a ratio that is not valid, for a method that is not available, and for
/// several kinds of tubes where the method handles only one (paper).
void validate(const KnownScene& known, const ModelSettings& settings);

/// Models the tubes of a cloud (m, world frame; a subset of what the known camera saw, in any order; labels
/// and colours are ignored) from a share of its points. Every point gets a label, also those left out of the
/// modelling. The result follows from the arguments alone. Throws InputError as validate() does, and for a
/// cloud that cannot show this scene: one in millimetres, say. Its messages name no file.
Model model_tubes(const PointCloud& cloud, const KnownScene& known, const ModelSettings& settings = {});

}  // namespace tanglebin
