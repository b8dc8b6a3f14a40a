#include "tanglebin/model/paper/fit.hpp"

#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_cylinder.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "tanglebin/model/paper/pcl_cloud.hpp"

namespace tanglebin {
namespace {

using CylinderModel = pcl::SampleConsensusModelCylinder<pcl::PointXYZ, pcl::Normal>;

/// An infinite cylinder and its inliers.
struct EndlessCylinder {
  Eigen::Vector3d point;  ///< on the axis
  Eigen::Vector3d axis;   ///< unit
  std::vector<std::size_t> points;
};

OrientedCloud part_of(const OrientedCloud& cloud, const std::vector<std::size_t>& indices) {
  OrientedCloud part;
  for (const std::size_t i : indices) {
    part.points.push_back(cloud.points[i]);
    part.normals.push_back(cloud.normals[i]);
    part.curvatures.push_back(cloud.curvatures[i]);
  }
  return part;
}

std::shared_ptr<CylinderModel> cylinder_model(const OrientedCloud& points, double radius,
                                              const FitSettings& settings) {
  const auto positions = pcl_points(points.points);
  const auto tree = pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  tree->setInputCloud(positions);
  auto model = std::make_shared<CylinderModel>(positions);
  model->setInputNormals(pcl_normals(points));
  model->setNormalDistanceWeight(settings.normal_weight);
  model->setRadiusLimits(radius * (1 - settings.radius_tolerance), radius * (1 + settings.radius_tolerance));
  model->setSamplesMaxDist(settings.sample_distance, tree);
  return model;
}

// The cylinder with the most inliers among the given points.
std::optional<EndlessCylinder> best_cylinder(const OrientedCloud& cloud,
                                             const std::vector<std::size_t>& indices, double radius,
                                             const FitSettings& settings) {
  const auto model = cylinder_model(part_of(cloud, indices), radius, settings);
  pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, settings.distance_max);
  ransac.setMaxIterations(settings.iterations_max);
  if (!ransac.computeModel()) return std::nullopt;

  pcl::Indices inliers;
  Eigen::VectorXf coefficients;
  ransac.getInliers(inliers);
  ransac.getModelCoefficients(coefficients);
  if (inliers.size() < static_cast<std::size_t>(settings.points_min)) return std::nullopt;
  Eigen::VectorXf refined;
  model->optimizeModelCoefficients(inliers, coefficients, refined);
  pcl::Indices refined_inliers;
  model->selectWithinDistance(refined, settings.distance_max, refined_inliers);
  if (refined_inliers.size() > inliers.size()) {
    inliers.swap(refined_inliers);
    coefficients.swap(refined);
  }

  EndlessCylinder cylinder{
      coefficients.head<3>().cast<double>(), coefficients.segment<3>(3).cast<double>().normalized(), {}};
  for (const pcl::index_t inlier : inliers) {
    cylinder.points.push_back(indices[static_cast<std::size_t>(inlier)]);
  }
  return cylinder;
}

// The longest run of inliers without a gap along the axis, as a cylinder with ends.
Cylinder densest_piece(const OrientedCloud& cloud, const EndlessCylinder& cylinder,
                       const FitSettings& settings) {
  std::vector<std::pair<double, std::size_t>> along;  // position on the axis, point
  for (const std::size_t i : cylinder.points) {
    along.emplace_back(cylinder.axis.dot(cloud.points[i].cast<double>() - cylinder.point), i);
  }
  std::ranges::sort(along);
  auto best_first = along.begin();
  auto best_last = along.begin();
  for (auto first = along.begin(); first != along.end();) {
    const auto gap = std::adjacent_find(first, along.end(), [&](const auto& here, const auto& next) {
      return next.first - here.first > settings.gap_max;
    });
    const auto last = gap == along.end() ? gap : std::next(gap);
    if (last - first > best_last - best_first) {
      best_first = first;
      best_last = last;
    }
    first = last;
  }

  const double start = best_first->first;
  const double end = std::prev(best_last)->first;
  const double trim = std::min(settings.trim, (end - start) / 4);
  Cylinder piece{
      {cylinder.point + (start + trim) * cylinder.axis, cylinder.point + (end - trim) * cylinder.axis},
      {},
      trim};
  std::transform(best_first, best_last, std::back_inserter(piece.points),
                 [](const auto& point) { return point.second; });
  std::ranges::sort(piece.points);
  return piece;
}

// True if a point is so near to the piece that it must not be fitted again.
bool is_about(const Cylinder& piece, const Eigen::Vector3d& point, double radius,
              const FitSettings& settings) {
  const Eigen::Vector3d axis = (piece.ends[1] - piece.ends[0]).normalized();
  const Eigen::Vector3d from_end = point - piece.ends[0];
  const double along = axis.dot(from_end);
  const double length = (piece.ends[1] - piece.ends[0]).norm();
  if (along < -settings.trim || along > length + settings.trim) return false;
  return std::abs((from_end - along * axis).norm() - radius) < settings.claim_distance;
}

}  // namespace

std::vector<Cylinder> fit_cylinders(const OrientedCloud& cloud, const std::vector<std::size_t>& cluster,
                                    double radius, const FitSettings& settings) {
  const QuietPcl quiet;
  std::vector<Cylinder> cylinders;
  std::vector<std::size_t> left = cluster;
  while (left.size() >= static_cast<std::size_t>(settings.points_min)) {
    const auto found = best_cylinder(cloud, left, radius, settings);
    if (!found) break;
    Cylinder piece = densest_piece(cloud, *found, settings);
    if (piece.points.size() < static_cast<std::size_t>(settings.points_min)) break;
    const bool is_long_enough = (piece.ends[1] - piece.ends[0]).norm() >= settings.length_min;
    std::erase_if(left, [&](std::size_t i) {
      return is_about(piece, cloud.points[i].cast<double>(), radius, settings) ||
             std::ranges::binary_search(piece.points, i);
    });
    if (is_long_enough) cylinders.push_back(std::move(piece));
  }
  return cylinders;
}

}  // namespace tanglebin
