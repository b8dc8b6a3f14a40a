#include "tanglebin/model/paper/segment.hpp"

#include <pcl/segmentation/region_growing.h>

#include "tanglebin/model/paper/pcl_cloud.hpp"

namespace tanglebin {

std::vector<std::vector<std::size_t>> grow_regions(const OrientedCloud& cloud,
                                                   const RegionSettings& settings) {
  if (cloud.points.empty()) return {};
  pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
  growing.setInputCloud(pcl_points(cloud.points));
  growing.setInputNormals(pcl_normals(cloud));
  growing.setNumberOfNeighbours(static_cast<unsigned>(settings.neighbours));
  growing.setSmoothnessThreshold(static_cast<float>(settings.angle_max));
  growing.setCurvatureThreshold(static_cast<float>(settings.curvature_max));
  growing.setMinClusterSize(static_cast<pcl::uindex_t>(settings.points_min));
  std::vector<pcl::PointIndices> regions;
  growing.extract(regions);

  std::vector<std::vector<std::size_t>> clusters;
  clusters.reserve(regions.size());
  for (const pcl::PointIndices& region : regions) {
    clusters.emplace_back(region.indices.begin(), region.indices.end());
  }
  return clusters;
}

}  // namespace tanglebin
