#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/model/axis_votes.hpp"
#include "tanglebin/model/filter.hpp"
#include "tanglebin/model/fragments.hpp"
#include "tanglebin/model/label.hpp"
#include "tanglebin/model/links.hpp"
#include "tanglebin/model/model.hpp"
#include "tanglebin/model/tube_fit.hpp"

namespace tanglebin {

/// The parameters of the axis method; docs/algorithm.md says how they were found.
struct AxisSettings {
  FilterSettings filter;
  VoteSettings vote;
  FragmentSettings fragment;
  LinkSettings link;
  TubeFitSettings fit;
  LabelSettings label;
};

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
