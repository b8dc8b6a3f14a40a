#include "tanglebin/scan/scan_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "tanglebin/base/expect.hpp"
#include "tanglebin/cloud/label_colors.hpp"

namespace tanglebin {
namespace {

bool is_point(const Pixel& pixel, CloudOf what) {
  const std::int32_t lowest = what == CloudOf::tubes ? bin_label + 1 : bin_label;
  return pixel.label >= lowest;
}

/// A cloud of missing points.
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

/// A value for each pixel of the whole image, with `background` outside the scan's window.
template <typename Value, typename ValueOf>
std::vector<Value> whole_image(const Scan& scan, Value background, ValueOf value_of) {
  const auto width = static_cast<std::size_t>(scan.camera.width);
  std::vector<Value> values(width * static_cast<std::size_t>(scan.camera.height), background);
  auto pixel = scan.pixels.begin();
  for (int v = scan.window.top; v < scan.window.top + scan.window.height; ++v) {
    for (int u = scan.window.left; u < scan.window.left + scan.window.width; ++u) {
      values[static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u)] = value_of(*pixel++);
    }
  }
  return values;
}

std::vector<Color> colors_for(const Scan& scan, int tubes) {
  std::int32_t largest = 0;
  for (const Pixel& pixel : scan.pixels) largest = std::max(largest, pixel.label);
  expect(tubes >= largest, "tubes", fmt::format("{}", tubes),
         fmt::format("at least {}, the largest label of the scan", largest));
  return label_colors(tubes);
}

}  // namespace

PointCloud cloud_from_scan(const Scan& scan, CloudOf what, int tubes, const PointProperties& properties) {
  const std::vector<Color> colors = colors_for(scan, tubes);
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
  const std::vector<Color> colors = colors_for(scan, tubes);
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

DepthImage depth_image(const Scan& scan) {
  return {scan.camera.width, scan.camera.height,
          whole_image(scan, std::numeric_limits<float>::quiet_NaN(),
                      [](const Pixel& pixel) { return pixel.depth; })};
}

LabelImage label_image(const Scan& scan) {
  return {scan.camera.width, scan.camera.height,
          whole_image(scan, null_label, [](const Pixel& pixel) { return pixel.label; })};
}

}  // namespace tanglebin
