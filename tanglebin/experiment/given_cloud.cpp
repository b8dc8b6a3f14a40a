#include "tanglebin/experiment/given_cloud.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/picked.hpp"
#include "tanglebin/model/scene/support_frame.hpp"
#include "tanglebin/score/score_clouds.hpp"

namespace tanglebin {
namespace {

Cropped cropped(const PointCloud& cloud, const KnownScene& known) {
  if (is_in_support_frame(known)) return crop(cloud, known.support, {});
  const Seen seen = in_support_frame(cloud, known);
  return crop(seen.cloud, seen.known.support, {});
}

}  // namespace

SeenPoints seen_points(const PointCloud& cloud, const KnownScene& known, double ratio, std::uint64_t seed) {
  SeenPoints seen{.cropped = cropped(cloud, known), .given = {}, .scored = {}};
  seen.scored = downsample(seen.cropped.kept, ratio, seed);
  if (ratio == 1) {
    seen.given.resize(cloud.points.size());
    std::iota(seen.given.begin(), seen.given.end(), std::size_t{0});
    return seen;
  }
  seen.given = seen.scored;
  for (const auto* others : {&seen.cropped.support, &seen.cropped.outside})
    std::ranges::copy(downsample(*others, ratio, seed), std::back_inserter(seen.given));
  std::ranges::sort(seen.given);
  return seen;
}

PointCloud given_cloud(const PointCloud& cloud, const SeenPoints& seen) {
  PointCloud own;
  own.points = picked(cloud.points, seen.given);
  if (!cloud.intensities.empty()) own.intensities = picked(cloud.intensities, seen.given);
  own.viewpoint = cloud.viewpoint;
  const bool is_whole = own.points.size() == cloud.points.size();
  own.width = is_whole ? cloud.width : own.points.size();
  own.height = is_whole ? cloud.height : 1;
  return own;
}

std::vector<std::int32_t> labels_of_points(const PointCloud& cloud, GivenLabels labels,
                                           const std::string& file) {
  if (const auto* labelled = std::get_if<PointCloud>(&labels))
    return match_points(cloud, *labelled, predicted_labels(*labelled, file), file);
  auto& in_order = std::get<std::vector<std::int32_t>>(labels);
  if (in_order.size() != cloud.points.size())
    throw InputError({file, 0, ""}, fmt::format("{} labels", in_order.size()),
                     fmt::format("{}, one for each point of the cloud", cloud.points.size()));
  return std::move(in_order);
}

}  // namespace tanglebin
