#include "tanglebin/model/label.hpp"

#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>

#include "tanglebin/model/pcl_cloud.hpp"

namespace tanglebin {
std::vector<std::int32_t> label_by_nearest(const PointCloud& cloud, const std::vector<std::size_t>& points,
                                           const std::vector<Tube>& tubes, const LabelSettings& settings) {
  std::vector<std::int32_t> labels(points.size(), null_label);
  if (points.empty()) return labels;
  std::vector<Eigen::Vector3f> positions;
  positions.reserve(points.size());
  for (const std::size_t point : points) positions.push_back(cloud.points[point]);
  pcl::search::KdTree<pcl::PointXYZ> tree(false);
  tree.setInputCloud(pcl_points(positions));

  // Each capsule claims the points around it that no nearer one has claimed.
  std::vector<double> nearest(points.size(), settings.distance_max);
  pcl::Indices around;
  std::vector<float> squared_distances;
  for (const Tube& tube : tubes) {
    for (const Capsule& capsule : capsules(tube)) {
      const Eigen::Vector3d centre = (capsule.a + capsule.b) / 2;
      const double reach = (capsule.b - capsule.a).norm() / 2 + capsule.radius + settings.distance_max;
      const pcl::PointXYZ query(static_cast<float>(centre.x()), static_cast<float>(centre.y()),
                                static_cast<float>(centre.z()));
      tree.radiusSearch(query, reach, around, squared_distances);
      for (const pcl::index_t found : around) {
        const auto i = static_cast<std::size_t>(found);
        const double distance =
            std::abs(axis_distance(capsule, positions[i].cast<double>()) - capsule.radius);
        if (distance >= nearest[i]) continue;
        nearest[i] = distance;
        labels[i] = tube.id;
      }
    }
  }
  return labels;
}

}  // namespace tanglebin
