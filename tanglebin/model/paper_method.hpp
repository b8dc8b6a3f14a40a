#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/model/filter.hpp"
#include "tanglebin/model/fit.hpp"
#include "tanglebin/model/join.hpp"
#include "tanglebin/model/label.hpp"
#include "tanglebin/model/model.hpp"
#include "tanglebin/model/segment.hpp"

namespace tanglebin {

/// The parameters of the paper's method. The paper gives no values; docs/algorithm.md says how these were
/// found and what each trades.
struct PaperSettings {
  FilterSettings filter;
  SegmentSettings segment;
  FitSettings fit;
  JoinSettings join;
  LabelSettings label;
};

/// A model and what the steps before made of the cloud.
struct PaperModel {
  Model model;
  OrientedCloud filtered;
  std::vector<std::vector<std::size_t>> clusters;  ///< of indices into filtered's arrays
  std::vector<Cylinder> cylinders;
  std::vector<Join> joins;
};

/// The tube modelling algorithm of the paper (Section 4), for tubes that are chains of cylinders. Arguments
/// as for model_tubes().
PaperModel model_as_in_paper(const PointCloud& cloud, const KnownScene& known, double ratio,
                             std::uint64_t seed, const PaperSettings& settings = {});

}  // namespace tanglebin
