// Region growing (Rabbani et al. 2006), by the Point Cloud Library: neighbours whose normals differ by less
// than an angle are on one tube.
//
//   tanglebin experiment dataset --out results --method regions='region_growing {cloud.pcd} {scene}
//   {out.pcd}'
#include <pcl/features/normal_3d.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/region_growing.h>

#include "points_and_labels.hpp"

int main(int argc, char** argv) {
  if (argc != 4) throw std::runtime_error("usage: region_growing CLOUD SCENE OUT");
  const Points::Ptr points = read_points(argv[1]);
  const pcl::IndicesPtr kept = without_bin(*points, argv[2]);
  constexpr int neighbours = 20;

  std::vector<pcl::PointIndices> regions;
  if (kept->size() > neighbours) {
    const Points::Ptr tubes = std::make_shared<Points>(*points, *kept);
    const auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
    const auto normals = std::make_shared<pcl::PointCloud<pcl::Normal>>();
    pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
    estimation.setInputCloud(tubes);
    estimation.setSearchMethod(tree);
    estimation.setKSearch(neighbours);
    estimation.setViewPoint(0, 0, 2);  // above the bin, as the camera is
    estimation.compute(*normals);

    pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
    growing.setInputCloud(tubes);
    growing.setInputNormals(normals);
    growing.setSearchMethod(tree);
    growing.setNumberOfNeighbours(neighbours);
    growing.setMinClusterSize(20);
    growing.setSmoothnessThreshold(0.2F);  // rad
    growing.setCurvatureThreshold(0.1F);
    growing.extract(regions);
    for (pcl::PointIndices& region : regions) {
      for (int& point : region.indices) point = (*kept)[static_cast<std::size_t>(point)];
    }
  }
  write_labels(argv[3], *points, regions);
}
