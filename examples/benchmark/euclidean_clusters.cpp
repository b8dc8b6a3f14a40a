// Euclidean clusters (Rusu 2009, Section 6.2), by the Point Cloud Library: points that are nearer to each
// other than a distance are on one tube. Tubes that touch become one.
//
//   tanglebin experiment dataset --out results --method clusters='euclidean_clusters {cloud.pcd} {scene}
//   {out.pcd}'
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include "points_and_labels.hpp"

int main(int argc, char** argv) {
  if (argc != 4) throw std::runtime_error("usage: euclidean_clusters CLOUD SCENE OUT");
  const Points::Ptr points = read_points(argv[1]);
  const pcl::IndicesPtr kept = without_bin(*points, argv[2]);

  std::vector<pcl::PointIndices> clusters;
  if (!kept->empty()) {
    pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
    extraction.setInputCloud(points);
    extraction.setIndices(kept);
    extraction.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
    extraction.setClusterTolerance(0.006);  // m
    extraction.setMinClusterSize(20);
    extraction.extract(clusters);
  }
  write_labels(argv[3], *points, clusters);
}
