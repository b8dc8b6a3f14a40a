#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/io/labels.hpp"
#include "tanglebin/model/scene/filter.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// Which points of a case's cloud are looked at, with a ratio and seed of downsampling: the same as by the
/// built-in methods with their default settings.
struct SeenPoints {
  Cropped cropped;
  std::vector<std::size_t> given;   ///< ascending: all if the ratio is 1, else without those of no position
  std::vector<std::size_t> scored;  ///< those of them that a filter by the support alone leaves
};
SeenPoints seen_points(const PointCloud& cloud, const KnownScene& known, double ratio, std::uint64_t seed);

/// A case's cloud as an algorithm from outside gets it: of SeenPoints::given, what a scanner measures,
/// without the truth. Points, intensities, viewpoint; organized only if it is whole.
PointCloud given_cloud(const PointCloud& cloud, const SeenPoints& seen);

/// A label for each point of `cloud`. Throws InputError naming `file` if there are not as many labels as
/// points, and as match_points() does.
std::vector<std::int32_t> labels_of_points(const PointCloud& cloud, GivenLabels labels,
                                           const std::string& file);

}  // namespace tanglebin
