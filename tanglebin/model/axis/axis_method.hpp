#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/model/axis/axis_settings.hpp"
#include "tanglebin/model/axis/axis_votes.hpp"
#include "tanglebin/model/axis/fragments.hpp"
#include "tanglebin/model/axis/links.hpp"
#include "tanglebin/model/axis/tube_fit.hpp"
#include "tanglebin/model/scene/filter.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/label.hpp"
#include "tanglebin/model/scene/model.hpp"

namespace tanglebin {

/// What the steps made of the points on one kind of tubes. Points are counted in Model::filtered.
struct AxisSteps {
  AxisVotes votes;
  std::vector<Fragment> fragments;
  std::vector<Link> links;
  std::vector<std::size_t> chosen;              ///< of the links
  std::vector<std::vector<std::size_t>> tubes;  ///< the fragments of each
};

/// A model and what the steps before made of the cloud, for each known kind of tubes.
struct AxisModel {
  Model model;
  std::vector<AxisSteps> kinds;
};

/// Tubes by their axes (docs/algorithm.md): every point and its normal vote for a point on an axis of the
/// known radius; the votes of a piece that is seen are a thin curve; these are joined by a matching of
/// greatest likelihood, and fitted to the points by least squares. For chains and trees. Arguments as for
/// model_tubes().
AxisModel model_by_axes(const PointCloud& cloud, const KnownScene& known, double ratio, std::uint64_t seed,
                        const AxisSettings& settings = {});

}  // namespace tanglebin
