#pragma once

#include <pcl/PointIndices.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

using Points = pcl::PointCloud<pcl::PointXYZ>;

inline Points::Ptr read_points(const std::string& file) {
  const auto points = std::make_shared<Points>();
  if (pcl::io::loadPCDFile(file, *points) != 0) throw std::runtime_error("cannot read " + file);
  return points;
}

/// A number of the scene file's [support], m: "length", "width" or "wall".
inline float support(const std::string& scene_file, const std::string& key) {
  std::ifstream scene(scene_file);
  bool is_support = false;
  for (std::string line; std::getline(scene, line);) {
    if (line.rfind('[', 0) == 0) is_support = line == "[support]";
    if (is_support && line.rfind(key + " = ", 0) == 0) return std::stof(line.substr(key.size() + 3));
  }
  throw std::runtime_error("no " + key + " of a bin in " + scene_file);
}

/// The points (m, from the centre of the bin's floor, z up) that are not on its floor or walls.
inline pcl::IndicesPtr without_bin(const Points& points, const std::string& scene_file) {
  constexpr float margin = 0.001F;  // m
  const float x = support(scene_file, "length") / 2 - margin;
  const float y = support(scene_file, "width") / 2 - margin;
  const auto kept = std::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const pcl::PointXYZ& point = points[i];
    if (std::abs(point.x) < x && std::abs(point.y) < y && point.z > margin)
      kept->push_back(static_cast<int>(i));
  }
  return kept;
}

/// Writes all points as they were read, with a label from 1 for those in a cluster, and 0 for the others.
inline void write_labels(const std::string& file, const Points& points,
                         const std::vector<pcl::PointIndices>& clusters) {
  pcl::PointCloud<pcl::PointXYZL> labelled;
  for (const pcl::PointXYZ& point : points) labelled.push_back({point.x, point.y, point.z, 0});
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    for (const int point : clusters[i].indices) labelled[point].label = static_cast<std::uint32_t>(i + 1);
  }
  if (pcl::io::savePCDFileBinary(file, labelled) != 0) throw std::runtime_error("cannot write " + file);
}
