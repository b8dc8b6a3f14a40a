#include "tanglebin/cloud/cloud.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "tanglebin/geometry/labels.hpp"

namespace tanglebin {
namespace {

void check_length(std::size_t values, std::size_t points, const char* what) {
  if (values != 0 && values != points) {
    throw std::invalid_argument(std::string("point cloud: the number of ") + what +
                                " must be the number of points, or 0");
  }
}

}  // namespace

void check_cloud(const PointCloud& cloud) {
  const std::size_t points = cloud.points.size();
  check_length(cloud.labels.size(), points, "labels");
  check_length(cloud.colors.size(), points, "colours");
  check_length(cloud.normals.size(), points, "normals");
  check_length(cloud.intensities.size(), points, "intensities");
  check_length(cloud.mixed.size(), points, "marks of mixed points");
  if (cloud.width * cloud.height != points) {
    throw std::invalid_argument("point cloud: width * height must be the number of points");
  }
  const auto lowest = std::ranges::min_element(cloud.labels);
  if (lowest != cloud.labels.end() && *lowest < null_label) {
    throw std::invalid_argument("point cloud: a label of " + std::to_string(*lowest) +
                                "; labels are -1 (null), 0 (the bin) and the numbers of tubes, from 1");
  }
}

}  // namespace tanglebin
