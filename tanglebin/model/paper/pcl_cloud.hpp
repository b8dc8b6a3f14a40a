#pragma once

#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "tanglebin/model/paper/normals.hpp"

// Internal to the room: types of the Point Cloud Library.
namespace tanglebin {

/// Copies of points and normals as PCL clouds.
pcl::PointCloud<pcl::PointXYZ>::Ptr pcl_points(const std::vector<Eigen::Vector3f>& points);
pcl::PointCloud<pcl::Normal>::Ptr pcl_normals(const OrientedCloud& cloud);

/// Silences PCL while it exists. PCL's complaints (two samples at one place, no cylinder found) are normal
/// here.
class QuietPcl {
public:
  QuietPcl() : level_(pcl::console::getVerbosityLevel()) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  ~QuietPcl() { pcl::console::setVerbosityLevel(level_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

private:
  pcl::console::VERBOSITY_LEVEL level_;
};

}  // namespace tanglebin
