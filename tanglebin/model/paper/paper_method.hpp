#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/model/paper/fit.hpp"
#include "tanglebin/model/paper/join.hpp"
#include "tanglebin/model/paper/normals.hpp"
#include "tanglebin/model/paper/paper_settings.hpp"
#include "tanglebin/model/paper/segment.hpp"
#include "tanglebin/model/scene/filter.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/label.hpp"
#include "tanglebin/model/scene/model.hpp"

namespace tanglebin {

/// A model, with the results of the steps.
struct PaperModel {
  Model model;
  OrientedCloud filtered;
  std::vector<std::vector<std::size_t>> clusters;  ///< indices into filtered's arrays
  std::vector<Cylinder> cylinders;
  std::vector<Join> joins;
};

/// Throws InputError if this program was built without the Point Cloud Library, which the paper's method
/// needs.
void expect_paper_method();

/// The paper's tube modelling algorithm (Section 4), for tubes that are chains of cylinders. Arguments as for
/// model_tubes(). Throws InputError if built without the Point Cloud Library.
PaperModel model_as_in_paper(
    const PointCloud& cloud, const KnownScene& known, double ratio, std::uint64_t seed,
    const PaperSettings& settings = {}, const std::function<void()>& at_step = [] {});

}  // namespace tanglebin
