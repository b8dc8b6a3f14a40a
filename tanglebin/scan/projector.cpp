#include "tanglebin/scan/projector.hpp"

#include <cmath>
#include <cstddef>

namespace tanglebin {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A tile's pixels extend half a pixel beyond their centres; a little more for rounding.
constexpr double tile_margin = 0.51;

constexpr double contact = 1e-4;  // m

int tiles(int pixels, int tile_size) {
  return (pixels + tile_size - 1) / tile_size;
}

}  // namespace

Camera projector_beside(const Camera& camera, const Sensor& sensor) {
  Camera projector = camera;
  const auto& axes = camera.pose.linear();
  const Vector3d position = camera.pose.translation() + sensor.baseline * axes.col(0);
  const Vector3d target = camera.pose.translation() + sensor.working_distance * axes.col(2);
  const Vector3d z = (target - position).normalized();
  projector.pose.linear() << axes.col(1).cross(z), axes.col(1), z;
  projector.pose.translation() = position;
  return projector;
}

Projector::Projector(const Surfaces& surfaces, const Camera& camera, const Sensor& sensor)
    : surfaces_(surfaces),
      view_(projector_beside(camera, sensor)),
      index_(surfaces, view_, tile_margin),
      columns_(tiles(view_.width, index_.tile_size())),
      of_tile_(static_cast<std::size_t>(columns_) *
               static_cast<std::size_t>(tiles(view_.height, index_.tile_size()))) {}

bool Projector::lights(const Vector3d& point, const Vector3d& normal) {
  const Vector3d from = position();
  const Vector3d way = point - from;
  if (way.dot(normal) >= 0) return false;
  const auto pixel = project(view_, point);
  if (!pixel || !((pixel->array() >= -0.5).all() && pixel->x() < view_.width - 0.5 &&
                  pixel->y() < view_.height - 0.5)) {
    return false;
  }
  const double distance = way.norm();
  return !is_blocked(surfaces_, candidates_at(*pixel), {from, way / distance}, distance - contact);
}

const Candidates& Projector::candidates_at(const Vector2d& pixel) {
  const int column = static_cast<int>(std::floor(pixel.x() + 0.5)) / index_.tile_size();
  const int row = static_cast<int>(std::floor(pixel.y() + 0.5)) / index_.tile_size();
  auto& candidates = of_tile_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                              static_cast<std::size_t>(column)];
  if (!candidates) index_.find(column * index_.tile_size(), row * index_.tile_size(), candidates.emplace());
  return *candidates;
}

}  // namespace tanglebin
