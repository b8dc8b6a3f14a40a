#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "tanglebin/cloud/cloud.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/intersect.hpp"

// What the scanner in tanglebin/scan does not know: tubes with flat ends, and things that are no tubes.
namespace tanglebin::test {

/// A camera 1 m above the origin whose pixels are 0.5 mm wide there.
inline Camera near_camera() {
  return downward_camera(800, 600, 2000, {0, 0, 1});
}

/// The distance along a ray at which it meets a surface, m; none if it misses.
using Surface = std::function<std::optional<double>(const Ray&)>;

/// A surface and the label of its points.
struct Thing {
  std::int32_t label;
  Surface surface;
};

/// What the camera sees of some things: one ray through each pixel, and the nearest surface.
inline PointCloud seen_by(const Camera& camera, const std::vector<Thing>& things) {
  PointCloud cloud;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Ray ray = ray_through(camera, u, v);
      double nearest = std::numeric_limits<double>::infinity();
      std::int32_t label = 0;
      for (const Thing& thing : things) {
        const std::optional<double> distance = thing.surface(ray);
        if (!distance || *distance >= nearest) continue;
        nearest = *distance;
        label = thing.label;
      }
      if (!std::isfinite(nearest)) continue;
      cloud.points.push_back((ray.origin + nearest * ray.direction).cast<float>());
      cloud.labels.push_back(label);
    }
  }
  cloud.width = cloud.points.size();
  return cloud;
}

/// A cylinder from a to b that is cut flat at both ends.
inline Surface flat_cylinder(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius) {
  return [=](const Ray& ray) -> std::optional<double> {
    const Eigen::Vector3d axis = (b - a).normalized();
    const auto aside = [&](const Eigen::Vector3d& way) -> Eigen::Vector3d {
      return way - way.dot(axis) * axis;
    };
    std::optional<double> nearest;
    const auto take = [&](double t) {
      if (t > 0 && (!nearest || t < *nearest)) nearest = t;
    };
    const Eigen::Vector3d d = aside(ray.direction);
    const Eigen::Vector3d o = aside(ray.origin - a);
    const double half = d.dot(o);
    const double root = half * half - d.squaredNorm() * (o.squaredNorm() - radius * radius);
    if (root >= 0) {
      const double t = (-half - std::sqrt(root)) / d.squaredNorm();
      const double along = (ray.origin + t * ray.direction - a).dot(axis);
      if (along >= 0 && along <= (b - a).norm()) take(t);
    }
    for (const Eigen::Vector3d& end : {a, b}) {
      const double t = (end - ray.origin).dot(axis) / ray.direction.dot(axis);
      if (aside(ray.origin + t * ray.direction - end).norm() <= radius) take(t);
    }
    return nearest;
  };
}

inline Surface box(const Eigen::Vector3d& least, const Eigen::Vector3d& most) {
  return [=](const Ray& ray) -> std::optional<double> {
    const auto hit = ray_box(ray, {least, most});
    return hit ? std::optional(hit->distance) : std::nullopt;
  };
}

inline Surface ball(const Eigen::Vector3d& centre, double radius) {
  return [=](const Ray& ray) -> std::optional<double> {
    const auto hit = ray_capsule(ray, {centre, centre, radius});
    return hit ? std::optional(hit->distance) : std::nullopt;
  };
}

/// A floor with waves along x and y about z = 0.
inline Surface wavy_floor(double amplitude, double wavelength) {
  return [=](const Ray& ray) -> std::optional<double> {
    const auto height = [&](double t) {
      const Eigen::Vector3d point = ray.origin + t * ray.direction;
      const double turns = 2 * std::numbers::pi / wavelength;
      return point.z() - amplitude * std::sin(turns * point.x()) * std::sin(turns * point.y());
    };
    double t = -ray.origin.z() / ray.direction.z();
    for (int i = 0; i < 30 && std::abs(height(t)) > 1e-12; ++i) t -= height(t) / ray.direction.z();
    return t;
  };
}

}  // namespace tanglebin::test
