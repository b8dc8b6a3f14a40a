#include "tanglebin/model/scene/filter.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tanglebin/base/picked.hpp"
#include "tanglebin/base/random.hpp"

namespace tanglebin {

Cropped crop(const PointCloud& cloud, const Bin& bin, const FilterSettings& settings) {
  const auto bin_boxes = boxes(bin);
  Eigen::AlignedBox3d around;
  for (const Eigen::AlignedBox3d& box : bin_boxes) around.extend(box);
  around.min().array() -= settings.overhang;
  around.max().array() += settings.overhang;

  const auto is_of_bin = [&](const Eigen::Vector3d& point) {
    return std::ranges::any_of(bin_boxes, [&](const Eigen::AlignedBox3d& box) {
      return box.squaredExteriorDistance(point) < settings.margin * settings.margin;
    });
  };
  Cropped cropped;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3d point = cloud.points[i].cast<double>();
    if (!point.allFinite()) continue;
    if (!around.contains(point)) {
      cropped.outside.push_back(i);
    } else if (is_of_bin(point)) {
      cropped.bin.push_back(i);
    } else {
      cropped.kept.push_back(i);
    }
  }
  return cropped;
}

// Algorithm S (Knuth, The Art of Computer Programming, volume 2, 3.4.2).
std::vector<std::size_t> downsample(const std::vector<std::size_t>& indices, double ratio,
                                    std::uint64_t seed) {
  const auto wanted = static_cast<std::size_t>(std::llround(ratio * static_cast<double>(indices.size())));
  Rng rng(seed);
  std::vector<std::size_t> drawn;
  drawn.reserve(wanted);
  for (std::size_t i = 0; i < indices.size() && drawn.size() < wanted; ++i) {
    const auto left = static_cast<double>(indices.size() - i);
    if (left * uniform_real(rng, 0, 1) < static_cast<double>(wanted - drawn.size())) {
      drawn.push_back(indices[i]);
    }
  }
  return drawn;
}

std::vector<Eigen::Vector3f> points_seen(const PointCloud& cloud, const Cropped& cropped,
                                         const std::vector<std::size_t>& filtered, double ratio,
                                         std::uint64_t seed) {
  std::vector<Eigen::Vector3f> seen = picked(cloud.points, filtered);
  for (const auto* others : {&cropped.bin, &cropped.outside}) {
    std::ranges::copy(picked(cloud.points, downsample(*others, ratio, seed)), std::back_inserter(seen));
  }
  return seen;
}

}  // namespace tanglebin
