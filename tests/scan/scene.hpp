#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tanglebin/base/random.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/camera.hpp"
#include "tanglebin/geometry/tube.hpp"
#include "tests/geometry/example_tubes.hpp"

namespace tanglebin::test {

using Eigen::Vector3d;

inline constexpr double degree = std::numbers::pi / 180;
inline constexpr std::uint64_t seed = 2022;

inline Vector3d random_point(Rng& rng, const Eigen::AlignedBox3d& box) {
  Vector3d point;
  for (int axis = 0; axis < 3; ++axis) point[axis] = uniform_real(rng, box.min()[axis], box.max()[axis]);
  return point;
}

inline Vector3d random_direction(Rng& rng) {
  const Eigen::AlignedBox3d cube(Vector3d::Constant(-1), Vector3d::Constant(1));
  Vector3d direction = random_point(rng, cube);
  while (direction.norm() > 1 || direction.norm() < 0.1) direction = random_point(rng, cube);
  return direction.normalized();
}

/// Wide and flat: its floor fills the image.
inline Bin wide_bin() {
  return {.length = 8, .width = 8, .height = 0.01, .wall = 0.02, .friction = 1};
}

/// A tube through these points.
inline Tube chain(int id, double radius, const std::vector<Vector3d>& points) {
  Tube tube = tube_through(points);
  tube.id = id;
  tube.radius = radius;
  return tube;
}

/// Bent tubes of half a metre strewn over the bin. They pass through one another and into the walls: the
/// harder for a scanner.
inline std::vector<Tube> random_pile(Rng& rng, int tubes, const Bin& bin) {
  constexpr std::size_t cylinders = 7;
  const Eigen::AlignedBox3d space(Vector3d(-bin.length / 2, -bin.width / 2, 0.0125),
                                  Vector3d(bin.length / 2, bin.width / 2, bin.height));
  std::vector<Tube> pile;
  for (int id = 1; id <= tubes; ++id) {
    std::vector<Vector3d> points = {random_point(rng, space)};
    Vector3d direction = random_direction(rng);
    while (points.size() <= cylinders) {
      const Vector3d bent = (direction + 0.5 * random_direction(rng)).normalized();
      const Vector3d next = points.back() + 0.5 / cylinders * bent;
      const bool inside = space.contains(next);
      direction = inside ? bent : random_direction(rng);
      if (inside) points.push_back(next);
    }
    pile.push_back(chain(id, 0.0125, points));
  }
  return pile;
}

/// A camera at `position` that looks at `target`.
inline Camera camera_at(const Vector3d& position, const Vector3d& target, int width, int height,
                        double hfov) {
  Camera camera = downward_camera(width, height, focal_length_from_hfov(width, hfov), position);
  const Vector3d z = (target - position).normalized();
  const Vector3d x = z.unitOrthogonal();
  camera.pose.linear() << x, z.cross(x), z;
  return camera;
}

}  // namespace tanglebin::test
