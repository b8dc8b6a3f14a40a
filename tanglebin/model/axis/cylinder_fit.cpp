#include "tanglebin/model/axis/cylinder_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace tanglebin {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t window_points_min = 12;

/// Points around a point, m, relative to it.
struct Window {
  std::vector<Vector3d> points;
  Vector3d view;  // unit, towards the sensor

  // The square of a point's distance from the ray through the middle, which noise does not change.
  double aside(const Vector3d& point) const {
    const double depth = point.dot(view);
    return point.squaredNorm() - depth * depth;
  }
};

// A few hundred points are enough, whatever the resolution.
Window window_at(const PixelGrid& grid, std::size_t item, double reach) {
  constexpr int samples = 9;  // on each side
  const double width = 0.9 * reach;
  const double depth = 1.2 * reach;
  const Eigen::Vector3f point = grid.point(item);
  const auto [column, row] = grid.pixels()[item];
  const auto pixels = static_cast<int>(std::lround(grid.pixels_across(reach, point)));
  const int step = std::max(1, pixels / samples);
  Window around{{}, (grid.camera().pose.translation() - point.cast<double>()).normalized()};
  const PixelGrid::Window window = grid.window({column, row}, pixels);
  for (int v = row - pixels; v <= row + pixels; v += step) {
    const PixelGrid::Run run = window.row(v);
    for (std::size_t i = 0; i < run.size; i += static_cast<std::size_t>(step)) {
      const Vector3d way = (grid.point(run.first + i) - point).cast<double>();
      if (around.aside(way) <= width * width && std::abs(way.dot(around.view)) <= depth)
        around.points.push_back(way);
    }
  }
  return around;
}

/// A cylinder's axis, as a point and a unit direction, and its radius. m
struct Cylinder {
  Vector3d place;
  Vector3d axis;
  double radius;

  Vector3d from_axis(const Vector3d& point) const {
    const Vector3d way = point - place;
    return way - way.dot(axis) * axis;
  }
};

// The normal of the plane through the points within this distance, towards the sensor.
std::optional<Vector3d> normal_of(const Window& around, double distance) {
  Vector3d sum = Vector3d::Zero();
  Matrix3d products = Matrix3d::Zero();
  double count = 0;
  for (const Vector3d& point : around.points) {
    if (around.aside(point) > distance * distance) continue;
    sum += point;
    products += point * point.transpose();
    ++count;
  }
  if (count < static_cast<double>(window_points_min) / 2) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(products - sum * sum.transpose() / count);
  const Vector3d normal = solver.eigenvectors().col(0);
  return normal.dot(around.view) < 0 ? Vector3d(-normal) : normal;
}

// From the curvatures of the quadric through the points within this distance.
std::optional<Cylinder> first_guess(const Window& around, double reach) {
  constexpr double flat_share = 0.4;  // of the reach; on a cylinder as large as the reach nearly flat
  constexpr double curved_share = 0.7;
  const std::optional<Vector3d> normal = normal_of(around, flat_share * reach);
  if (!normal) return std::nullopt;
  const Vector3d side = normal->unitOrthogonal();
  const Vector3d other_side = normal->cross(side);
  using Terms = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> products = Eigen::Matrix<double, 6, 6>::Zero();
  Terms right_side = Terms::Zero();
  std::size_t count = 0;
  for (const Vector3d& point : around.points) {
    if (around.aside(point) > curved_share * reach * curved_share * reach) continue;
    const double x = point.dot(side) / reach;
    const double y = point.dot(other_side) / reach;
    const Terms terms = (Terms() << 1, x, y, x * x / 2, x * y, y * y / 2).finished();
    products += terms * terms.transpose();
    right_side += point.dot(*normal) / reach * terms;
    ++count;
  }
  if (count < window_points_min) return std::nullopt;
  const Terms quadric = products.ldlt().solve(right_side);
  Eigen::Matrix2d curvature;
  curvature << quadric[3], quadric[4], quadric[4], quadric[5];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(curvature);
  const double across = -solver.eigenvalues()[0];  // in inverse reaches
  constexpr double least = 0.4;
  if (!quadric.allFinite() || across < least || std::abs(solver.eigenvalues()[1]) > across / 2)
    return std::nullopt;
  const Eigen::Vector2d along = solver.eigenvectors().col(1);
  const double radius = reach / std::min(across, 2.0);
  return Cylinder{(quadric[0] * reach - radius) * *normal, along.x() * side + along.y() * other_side, radius};
}

/// A point that counts, and the place of the cylinder's surface before or behind it on its ray.
struct Inlier {
  Vector3d point;
  Vector3d normal;  // unit, of the surface
  double residual;  // m, of the point before the surface
};

struct Inliers {
  std::vector<Inlier> all;
  std::size_t facing = 0;  // number of points where the surface faces the sensor
  double noise = 0;        // m, root mean square of the residuals
};

// Where the ray through the point in the direction of the view meets the cylinder. None if it misses it.
std::optional<Inlier> on_surface(const Cylinder& cylinder, const Vector3d& view, const Vector3d& point) {
  const Vector3d way = cylinder.from_axis(point);
  const Vector3d across = view - view.dot(cylinder.axis) * cylinder.axis;
  const double half = way.dot(across);
  const double square = across.squaredNorm();
  const double discriminant = half * half - square * (way.squaredNorm() - cylinder.radius * cylinder.radius);
  if (!(discriminant > 0 && square > 0)) return std::nullopt;
  const double ahead = (std::sqrt(discriminant) - half) / square;
  return Inlier{point, (way + ahead * across) / cylinder.radius, -ahead};
}

// Noise is along the rays. Distances from the surface would look smaller on steep parts, and the radius too
// small: by the noise's variance over the radius, times 30 for an arc of 100°.
Inliers inliers_of(const Window& around, const Cylinder& cylinder, double residual_max) {
  constexpr double facing_min = 0.64;  // the cosine of 50°
  Inliers inliers;
  double squares = 0;
  for (const Vector3d& point : around.points) {
    const std::optional<Inlier> inlier = on_surface(cylinder, around.view, point);
    if (!inlier || inlier->normal.dot(around.view) < facing_min) continue;
    ++inliers.facing;
    if (std::abs(inlier->residual) > residual_max) continue;
    inliers.all.push_back(*inlier);
    squares += inlier->residual * inlier->residual;
  }
  constexpr double unknowns = 5;
  inliers.noise = std::sqrt(squares / std::max(1.0, static_cast<double>(inliers.all.size()) - unknowns));
  return inliers;
}

using Five = Eigen::Matrix<double, 5, 1>;
using FiveByFive = Eigen::Matrix<double, 5, 5>;

// A Gauss-Newton step on the residuals. Returns the inverse of the normal matrix.
FiveByFive improve(Cylinder& cylinder, const Inliers& inliers, const Vector3d& view) {
  const Vector3d side = cylinder.axis.unitOrthogonal();
  const Vector3d other_side = cylinder.axis.cross(side);
  FiveByFive products = FiveByFive::Zero();
  Five right_side = Five::Zero();
  for (const auto& [point, normal, residual] : inliers.all) {
    const double along = (point - cylinder.place).dot(cylinder.axis) / cylinder.radius;
    const double x = normal.dot(side);
    const double y = normal.dot(other_side);
    const Five row = (Five() << x, y, along * x, along * y, 1).finished() / normal.dot(view);
    products += row * row.transpose();
    right_side += residual * row;
  }
  FiveByFive inverse = products.ldlt().solve(FiveByFive::Identity());
  const Five step = inverse * right_side;
  cylinder.place += step[0] * side + step[1] * other_side;
  cylinder.axis = (cylinder.axis + (step[2] * side + step[3] * other_side) / cylinder.radius).normalized();
  cylinder.radius += step[4];
  return inverse;
}

// The mean residuals in equal parts of a range: their root mean square, less what noise contributes. m
double unevenness(const std::vector<double>& positions, const Inliers& inliers) {
  constexpr std::size_t parts = 5;
  const auto [least, most] = std::ranges::minmax(positions);
  std::array<double, parts> sums{};
  std::array<double, parts> counts{};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double share = (positions[i] - least) / (most - least);
    const auto part = std::min(parts - 1, static_cast<std::size_t>(share * parts));
    sums[part] += inliers.all[i].residual;
    ++counts[part];
  }
  double squares = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    if (counts[part] == 0) continue;
    const double mean = sums[part] / counts[part];
    squares += std::max(0.0, mean * mean - inliers.noise * inliers.noise / counts[part]);
  }
  return std::sqrt(squares / parts);
}

// On edges, balls and steps the residuals depend on the place; on a cylinder they are noise. And a short arc
// says little of the radius.
bool is_cylinder(const Cylinder& cylinder, const Inliers& inliers, const Vector3d& view) {
  std::vector<double> along;
  std::vector<double> around;
  const Vector3d side = cylinder.axis.cross(view).normalized();
  for (const auto& [point, normal, residual] : inliers.all) {
    along.push_back((point - cylinder.place).dot(cylinder.axis));
    around.push_back(std::atan2(normal.dot(side), normal.dot(side.cross(cylinder.axis))));
  }
  const auto length = [](const std::vector<double>& values) {
    const auto [least, most] = std::ranges::minmax(values);
    return most - least;
  };
  constexpr double uneven_max = 0.02;  // radii
  constexpr double arc_min = 1.0;      // rad
  constexpr double length_min = 0.8;   // radii
  return length(around) >= arc_min && length(along) >= length_min * cylinder.radius &&
         unevenness(along, inliers) <= uneven_max * cylinder.radius &&
         unevenness(around, inliers) <= uneven_max * cylinder.radius;
}

}  // namespace

std::optional<CylinderFit> fit_cylinder(const PixelGrid& grid, std::size_t item, double reach) {
  const Window around = window_at(grid, item, reach);
  if (around.points.size() < window_points_min) return std::nullopt;
  std::optional<Cylinder> cylinder = first_guess(around, reach);
  if (!cylinder) return std::nullopt;

  constexpr int iterations = 10;
  constexpr double residual_start = 0.3;  // radii
  constexpr double sigmas = 3;
  double residual_max = residual_start * cylinder->radius;
  Inliers inliers = inliers_of(around, *cylinder, residual_max);
  FiveByFive inverse;
  for (int i = 0; i < iterations; ++i) {
    if (inliers.all.size() < window_points_min || 2 * inliers.all.size() < inliers.facing)
      return std::nullopt;
    inverse = improve(*cylinder, inliers, around.view);
    constexpr double most = 2;  // reaches, either way
    if (!(cylinder->radius > reach / most && cylinder->radius < reach * most)) return std::nullopt;
    inliers = inliers_of(around, *cylinder, residual_max);
    residual_max = std::min(residual_max, std::max(sigmas * inliers.noise, 1e-3 * reach));
  }
  if (inliers.all.size() < window_points_min || !is_cylinder(*cylinder, inliers, around.view))
    return std::nullopt;
  return CylinderFit{cylinder->radius, inliers.noise * std::sqrt(inverse(4, 4))};
}

}  // namespace tanglebin
