#include "tanglebin/cloud/cloud.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "tanglebin/cloud/label_colors.hpp"

namespace tanglebin {
namespace {

bool is_point(const Pixel& pixel, CloudOf what) {
  const std::int32_t lowest = what == CloudOf::tubes ? bin_label + 1 : bin_label;
  return pixel.label >= lowest;
}

}  // namespace

void check_cloud(const PointCloud& cloud) {
  const std::size_t points = cloud.points.size();
  if (!cloud.labels.empty() && cloud.labels.size() != points) {
    throw std::invalid_argument("point cloud: as many labels as points are needed, or none");
  }
  if (!cloud.colors.empty() && cloud.colors.size() != points) {
    throw std::invalid_argument("point cloud: as many colours as points are needed, or none");
  }
  if (cloud.width * cloud.height != points) {
    throw std::invalid_argument("point cloud: width * height must be the number of points");
  }
  if (std::ranges::any_of(cloud.labels, [](std::int32_t label) { return label < null_label; })) {
    throw std::invalid_argument("point cloud: no label is below -1");
  }
}

PointCloud cloud_from_scan(const Scan& scan, CloudOf what, int tubes) {
  const std::vector<Color> colors = label_colors(tubes);
  const auto points = static_cast<std::size_t>(
      std::ranges::count_if(scan.pixels, [&](const Pixel& pixel) { return is_point(pixel, what); }));
  PointCloud cloud;
  cloud.points.reserve(points);
  cloud.labels.reserve(points);
  cloud.colors.reserve(points);
  for (const Pixel& pixel : scan.pixels) {
    if (!is_point(pixel, what)) continue;
    cloud.points.push_back(pixel.point);
    cloud.labels.push_back(pixel.label);
    cloud.colors.push_back(colors.at(static_cast<std::size_t>(pixel.label)));
  }
  cloud.width = points;
  cloud.viewpoint = scan.camera.pose;
  return cloud;
}

PointCloud organized_cloud_from_scan(const Scan& scan, CloudOf what, int tubes) {
  const std::vector<Color> colors = label_colors(tubes);
  PointCloud cloud;
  cloud.width = static_cast<std::size_t>(scan.camera.width);
  cloud.height = static_cast<std::size_t>(scan.camera.height);
  const std::size_t points = cloud.width * cloud.height;
  cloud.points.assign(points, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  cloud.labels.assign(points, null_label);
  cloud.colors.assign(points, null_color);
  const PixelWindow& window = scan.window;
  for (int v = window.top; v < window.top + window.height; ++v) {
    for (int u = window.left; u < window.left + window.width; ++u) {
      const Pixel& pixel = scan.at(u, v);
      if (!is_point(pixel, what)) continue;
      const std::size_t i = static_cast<std::size_t>(v) * cloud.width + static_cast<std::size_t>(u);
      cloud.points[i] = pixel.point;
      cloud.labels[i] = pixel.label;
      cloud.colors[i] = colors.at(static_cast<std::size_t>(pixel.label));
    }
  }
  cloud.viewpoint = scan.camera.pose;
  return cloud;
}

}  // namespace tanglebin
