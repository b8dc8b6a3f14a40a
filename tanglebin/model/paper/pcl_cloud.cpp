#include "tanglebin/model/paper/pcl_cloud.hpp"

namespace tanglebin {

pcl::PointCloud<pcl::PointXYZ>::Ptr pcl_points(const std::vector<Eigen::Vector3f>& points) {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve(points.size());
  for (const Eigen::Vector3f& point : points) cloud->emplace_back(point.x(), point.y(), point.z());
  return cloud;
}

pcl::PointCloud<pcl::Normal>::Ptr pcl_normals(const OrientedCloud& cloud) {
  auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  normals->reserve(cloud.normals.size());
  for (std::size_t i = 0; i < cloud.normals.size(); ++i) {
    const Eigen::Vector3f& normal = cloud.normals[i];
    normals->emplace_back(normal.x(), normal.y(), normal.z(), cloud.curvatures[i]);
  }
  return normals;
}

}  // namespace tanglebin
