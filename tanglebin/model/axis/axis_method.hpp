#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "tanglebin/model/axis/fragments/axis_votes.hpp"
#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/links/links.hpp"
#include "tanglebin/model/axis/links/tube_shapes.hpp"
#include "tanglebin/model/axis/settings/axis_settings.hpp"
#include "tanglebin/model/axis/tube_fit.hpp"
#include "tanglebin/model/scene/filter.hpp"
#include "tanglebin/model/scene/known_scene.hpp"
#include "tanglebin/model/scene/label.hpp"
#include "tanglebin/model/scene/model.hpp"

namespace tanglebin {

/// The results of the steps for one kind of tube. Point indices refer to Model::filtered.
struct AxisSteps {
  AxisVotes votes;
  std::vector<Fragment> fragments;
  std::vector<Link> links;
  std::vector<std::size_t> chosen;              ///< indices into links
  TubeShapes shapes;                            ///< of whole tubes, if they are alike
  std::vector<std::vector<std::size_t>> tubes;  ///< the fragments of each tube, in the order of Model::tubes
  TubeKind kind{};  ///< of these tubes; with the length that was found, if none was known
};

/// A model, with the results of the steps for each known kind of tube.
struct AxisModel {
  Model model;
  std::vector<AxisSteps> kinds;
};

/// The axis method (docs/algorithm.md). Every point votes, along its normal, for a point on a tube axis of
/// the known radius. The votes of each visible piece of a tube form a thin curve. Pieces are joined by a
/// maximum-likelihood matching and fitted to the points by least squares. Where few points are probably
/// right, the votes are cut into pieces again, in other places, and the likeliest model is the result
/// (likeliest_of()); the steps' times are those of all tries. For chains and trees. Arguments as for
/// model_tubes(), but all in the support's frame (in_support_frame()).
AxisModel model_by_axes(
    const PointCloud& cloud, const KnownScene& known, double ratio, std::uint64_t seed,
    const AxisSettings& given = {}, const std::function<void()>& at_step = [] {});

}  // namespace tanglebin
