#pragma once

#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "tanglebin/model/paper/normals.hpp"

// Internal to the room: the Point Cloud Library's types.
namespace tanglebin {

/// PCL's copies of points and normals, one cloud of each.
pcl::PointCloud<pcl::PointXYZ>::Ptr pcl_points(const std::vector<Eigen::Vector3f>& points);
pcl::PointCloud<pcl::Normal>::Ptr pcl_normals(const OrientedCloud& cloud);

/// While it lives, PCL prints nothing: what it complains of (two samples at one place, no cylinder found) is
/// everyday business here.
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
