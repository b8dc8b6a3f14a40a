#include "tanglebin/model/locate/plane_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/median.hpp"

namespace tanglebin {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A plane with a frame of its own.
struct Frame {
  Vector3d origin;  // m
  Vector3d x;
  Vector3d y;
  Vector3d normal;

  Vector3d local(const Vector3d& point) const {
    const Vector3d from = point - origin;
    return {x.dot(from), y.dot(from), normal.dot(from)};
  }
};

Frame frame_on(const Vector3d& normal, const Vector3d& origin) {
  const Vector3d x = normal.unitOrthogonal();
  return {origin, x, normal.cross(x), normal};
}

struct Sums {
  Matrix3d information = Matrix3d::Zero();  // of height (m) and slopes along x and y
  Vector3d gradient = Vector3d::Zero();
};

std::vector<Vector3d> within(const std::vector<Vector3d>& points, const Frame& frame, double gate) {
  std::vector<Vector3d> near;
  for (const Vector3d& point : points) {
    const Vector3d local = frame.local(point);
    if (std::abs(local.z()) < gate) near.push_back(local);
  }
  return near;
}

double spread_of(const std::vector<Vector3d>& local) {
  constexpr double smallest = 0.0001;
  std::vector<double> distances;
  distances.reserve(local.size());
  for (const Vector3d& point : local) distances.push_back(std::abs(point.z()));
  return distances.empty() ? smallest
                           : std::max(deviation_of_median * median(std::move(distances)), smallest);
}

double trust_of(double distance, double gate) {
  const double ratio = distance / gate;
  return (1 - ratio * ratio) * (1 - ratio * ratio);
}

/// Sums over a block of 0.15 m.
struct PlaneBlock {
  double weight = 0;
  double sum = 0;  // of distances, m
};

std::pair<long, long> block_of(const Vector3d& local) {
  constexpr double size = 0.15;
  return {std::lround(local.x() / size), std::lround(local.y() / size)};
}

using Blocks = std::map<std::pair<long, long>, PlaneBlock>;

Blocks blocks_of(const std::vector<Vector3d>& local, double gate) {
  Blocks blocks;
  for (const Vector3d& point : local) {
    PlaneBlock& block = blocks[block_of(point)];
    block.weight += trust_of(point.z(), gate);
    block.sum += trust_of(point.z(), gate) * point.z();
  }
  return blocks;
}

// RMS of the blocks' mean distances, m: an error that the points of a block share.
double shared_error(const Blocks& blocks) {
  constexpr double enough = 20;
  constexpr double smallest = 0.0001;
  double squares = 0;
  int count = 0;
  for (const auto& [place, block] : blocks) {
    if (block.weight < enough) continue;
    squares += block.sum / block.weight * block.sum / block.weight;
    ++count;
  }
  return count == 0 ? smallest : std::max(std::sqrt(squares / count), smallest);
}

Sums sums_of(const std::vector<Vector3d>& local, double gate, double spread, double shared) {
  const Blocks blocks = blocks_of(local, gate);
  Sums sums;
  for (const Vector3d& point : local) {
    const double variance = spread * spread + blocks.at(block_of(point)).weight * shared * shared;
    const double weight = trust_of(point.z(), gate) / variance;
    const Vector3d gradient(1, point.x(), point.y());
    sums.information += weight * gradient * gradient.transpose();
    sums.gradient += weight * point.z() * gradient;
  }
  return sums;
}

Vector3d middle_of(const std::vector<Vector3d>& local) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& point : local) sum += point;
  return sum / static_cast<double>(std::max<std::size_t>(local.size(), 1));
}

std::vector<Vector3d> points_of(const SensorView& view) {
  constexpr std::size_t points_max = 60000;
  std::vector<Vector3d> points;
  for (const std::size_t pixel : view.sample(points_max))
    points.emplace_back(view.points[pixel].cast<double>());
  return points;
}

double share_below(const std::vector<Vector3d>& points, const Frame& frame, double gate) {
  const auto below =
      std::ranges::count_if(points, [&](const Vector3d& point) { return frame.local(point).z() < -gate; });
  return static_cast<double>(below) / static_cast<double>(points.size());
}

// What is seen near the plane, alone.
SensorView only_near(SensorView view, const Frame& frame, double gate) {
  std::erase_if(view.seen, [&](std::size_t pixel) {
    Eigen::Vector3f& point = view.points[pixel];
    const bool is_near = std::abs(frame.local(point.cast<double>()).z()) < gate;
    if (!is_near) point.setConstant(std::numeric_limits<float>::quiet_NaN());
    return !is_near;
  });
  return view;
}

// Whether a patch is parallel to the plane, as far as its noise lets its direction be known.
bool is_parallel(const FlatPatch& patch, const Frame& frame) {
  const double least = std::tan(10 * degree);
  const double extent =
      std::sqrt(patch.area / 12);  // m, standard deviation of a square's points along a side
  const double slope = frame.normal.cross(patch.normal).norm() / std::abs(frame.normal.dot(patch.normal));
  return slope < std::max(least, patch.noise / extent);
}

// Of a table, all. A plane through a heap of tubes meets them at all angles.
double share_parallel(const SensorView& view, const Frame& frame, double gate) {
  double parallel = 0;
  double all = 0;
  for (const FlatPatch& patch : patches_of(only_near(view, frame, gate))) {
    all += patch.area;
    if (is_parallel(patch, frame)) parallel += patch.area;
  }
  return all > 0 ? parallel / all : 0;
}

}  // namespace

PlaneFit fit_plane(const SensorView& view, const FlatPlane& plane, double margin) {
  constexpr int rounds = 8;
  constexpr double deviations = 4;
  constexpr double narrowest = 0.0015;
  constexpr double smallest_information = 1e-6;
  const std::vector<Vector3d> points = points_of(view);
  Frame frame = frame_on(plane.normal, plane.offset * plane.normal);
  double gate = std::max(deviations * plane.noise, 0.004) + margin;
  std::vector<Vector3d> near;
  Matrix3d information = Matrix3d::Identity();
  double shared = 0;
  for (int round = 0; round < rounds; ++round) {
    const Vector3d middle = middle_of(within(points, frame, gate));
    frame.origin += middle.x() * frame.x + middle.y() * frame.y;
    near = within(points, frame, gate);
    const double spread = spread_of(near);
    shared = shared_error(blocks_of(near, gate));
    const Sums sums = sums_of(near, gate, spread, shared);
    information = sums.information + smallest_information * Matrix3d::Identity();
    const Vector3d step = information.ldlt().solve(sums.gradient);
    const Vector3d normal = (frame.normal - step[1] * frame.x - step[2] * frame.y).normalized();
    frame = frame_on(normal, frame.origin + step[0] * frame.normal);
    // Clutter spreads as far as the gate: it must not widen it.
    gate = std::min(gate, std::max(deviations * spread, narrowest) + margin);
  }
  near = within(points, frame, gate);
  double squares = 0;
  for (const Vector3d& point : near) squares += point.z() * point.z();
  const auto count = static_cast<double>(std::max<std::size_t>(near.size(), 1));
  PlaneFit fit{.frame = Eigen::Isometry3d::Identity(),
               .residual = std::sqrt(squares / count),
               .noise = spread_of(near),
               .points = static_cast<int>(near.size()),
               .explained = count / static_cast<double>(points.size()),
               .below = share_below(points, frame, 2 * gate),
               .parallel = share_parallel(view, frame, gate),
               .covariance = information.inverse()};
  fit.frame.linear() << frame.x, frame.y, frame.normal;
  fit.frame.translation() = frame.origin;
  fit.covariance(0, 0) += shared * shared;  // an error of all points leaves no residual
  return fit;
}

}  // namespace tanglebin
