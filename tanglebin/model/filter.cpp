#include "tanglebin/model/filter.hpp"

#include <pcl/features/normal_3d.h>

#include <algorithm>
#include <cmath>

#include "tanglebin/base/random.hpp"
#include "tanglebin/model/pcl_cloud.hpp"

namespace tanglebin {

std::vector<std::size_t> crop(const PointCloud& cloud, const Bin& bin, const FilterSettings& settings) {
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
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3d point = cloud.points[i].cast<double>();
    if (point.allFinite() && around.contains(point) && !is_of_bin(point)) kept.push_back(i);
  }
  return kept;
}

// Knuth, The Art of Computer Programming, volume 2, 3.4.2, Algorithm S.
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

OrientedCloud with_normals(const PointCloud& cloud, const std::vector<std::size_t>& indices,
                           const Eigen::Vector3d& sensor, const FilterSettings& settings) {
  OrientedCloud oriented;
  constexpr std::size_t points_of_a_plane = 3;
  if (indices.size() < points_of_a_plane) return oriented;
  oriented.indices = indices;
  for (const std::size_t index : indices) oriented.points.push_back(cloud.points[index]);

  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(pcl_points(oriented.points));
  estimation.setKSearch(settings.normal_neighbours);
  const Eigen::Vector3f viewpoint = sensor.cast<float>();
  estimation.setViewPoint(viewpoint.x(), viewpoint.y(), viewpoint.z());
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  for (const pcl::Normal& normal : normals) {
    oriented.normals.emplace_back(normal.getNormalVector3fMap());
    oriented.curvatures.push_back(normal.curvature);
  }
  return oriented;
}

}  // namespace tanglebin
