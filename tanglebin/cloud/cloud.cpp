#include "tanglebin/cloud/cloud.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "tanglebin/cloud/label_colors.hpp"

namespace tanglebin {
namespace {

bool is_point(const Pixel& pixel, CloudOf what) {
  const std::int32_t lowest = what == CloudOf::tubes ? bin_label + 1 : bin_label;
  return pixel.label >= lowest;
}

/// So many points that are not there.
PointCloud empty_cloud(std::size_t points, const PointProperties& properties) {
  const Eigen::Vector3f nowhere = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  PointCloud cloud;
  cloud.points.assign(points, nowhere);
  cloud.labels.assign(points, null_label);
  cloud.colors.assign(points, null_color);
  if (properties.normals) cloud.normals.assign(points, nowhere);
  if (properties.intensities) cloud.intensities.assign(points, 0);
  if (properties.mixed) cloud.mixed.assign(points, 0);
  return cloud;
}

void set_point(PointCloud& cloud, std::size_t point, const Scan& scan, std::size_t pixel,
               const std::vector<Color>& colors) {
  const Pixel& seen = scan.pixels[pixel];
  cloud.points[point] = seen.point;
  cloud.labels[point] = seen.label;
  cloud.colors[point] = colors.at(static_cast<std::size_t>(seen.label));
  if (!cloud.normals.empty()) cloud.normals[point] = seen.normal;
  if (!cloud.intensities.empty()) cloud.intensities[point] = scan.snr.empty() ? 1 : scan.snr[pixel];
  if (!cloud.mixed.empty()) cloud.mixed[point] = scan.mixed.empty() ? 0 : scan.mixed[pixel];
}

void check_length(std::size_t values, std::size_t points, const char* what) {
  if (values != 0 && values != points) {
    throw std::invalid_argument(std::string("point cloud: as many ") + what +
                                " as points are needed, or none");
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
  if (std::ranges::any_of(cloud.labels, [](std::int32_t label) { return label < null_label; })) {
    throw std::invalid_argument("point cloud: no label is below -1");
  }
}

PointCloud cloud_from_scan(const Scan& scan, CloudOf what, int tubes, const PointProperties& properties) {
  const std::vector<Color> colors = label_colors(tubes);
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < scan.pixels.size(); ++i) {
    if (is_point(scan.pixels[i], what)) seen.push_back(i);
  }
  PointCloud cloud = empty_cloud(seen.size(), properties);
  for (std::size_t point = 0; point < seen.size(); ++point)
    set_point(cloud, point, scan, seen[point], colors);
  cloud.width = seen.size();
  cloud.viewpoint = scan.camera.pose;
  return cloud;
}

PointCloud organized_cloud_from_scan(const Scan& scan, CloudOf what, int tubes,
                                     const PointProperties& properties) {
  const std::vector<Color> colors = label_colors(tubes);
  const auto width = static_cast<std::size_t>(scan.camera.width);
  const auto height = static_cast<std::size_t>(scan.camera.height);
  PointCloud cloud = empty_cloud(width * height, properties);
  cloud.width = width;
  cloud.height = height;
  const PixelWindow& window = scan.window;
  for (int v = window.top; v < window.top + window.height; ++v) {
    for (int u = window.left; u < window.left + window.width; ++u) {
      if (!is_point(scan.at(u, v), what)) continue;
      const std::size_t point = static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u);
      set_point(cloud, point, scan, scan.index(u, v), colors);
    }
  }
  cloud.viewpoint = scan.camera.pose;
  return cloud;
}

}  // namespace tanglebin
