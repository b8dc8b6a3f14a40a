#include "tanglebin/model/paper/normals.hpp"

#include <pcl/features/normal_3d.h>

#include "tanglebin/model/paper/pcl_cloud.hpp"

namespace tanglebin {

OrientedCloud with_normals(const PointCloud& cloud, const std::vector<std::size_t>& indices,
                           const Eigen::Vector3d& sensor, int neighbours) {
  OrientedCloud oriented;
  constexpr std::size_t points_of_a_plane = 3;
  if (indices.size() < points_of_a_plane) return oriented;
  oriented.indices = indices;
  for (const std::size_t index : indices) oriented.points.push_back(cloud.points[index]);

  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(pcl_points(oriented.points));
  estimation.setKSearch(neighbours);
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
