#include "tanglebin/model/axis/roundness.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "tanglebin/geometry/capsule.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

/// The cylinder of a tube that a point is nearest to, without its ends.
struct Nearest {
  Vector3d along;  // unit
  Vector3d way;    // m, from the axis to the point
};

std::optional<Nearest> nearest_cylinder(const std::vector<Capsule>& capsules, const Vector3d& point) {
  std::optional<Nearest> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Capsule& capsule : capsules) {
    const double t = nearest_on_axis(capsule, point);
    const Vector3d way = point - (capsule.a + t * (capsule.b - capsule.a));
    if (way.norm() >= least) continue;
    least = way.norm();
    nearest.reset();
    if (t > 0 && t < 1) nearest = Nearest{(capsule.b - capsule.a).normalized(), way};
  }
  return nearest;
}

/// Sums of two angles, rad, for the line of the second over the first.
struct Regression {
  double count = 0;
  double first = 0, second = 0, squares = 0, products = 0;

  void add(double x, double y) {
    ++count;
    first += x;
    second += y;
    squares += x * x;
    products += x * y;
  }
  double variance() const { return squares / count - first / count * first / count; }
  double slope() const { return (products / count - first / count * second / count) / variance(); }
};

}  // namespace

std::optional<double> roundness(const Tube& tube, const std::vector<Fragment>& fragments,
                                const std::vector<std::size_t>& members,
                                const std::vector<Eigen::Vector3f>& points, const AxisVotes& votes,
                                const Camera& camera) {
  std::vector<std::size_t> all;
  for (const std::size_t member : members)
    all.insert(all.end(), fragments[member].points.begin(), fragments[member].points.end());
  constexpr std::size_t looked_at = 400;
  const std::size_t stride = all.size() / looked_at + 1;
  const std::vector<Capsule> pieces = capsules(tube);
  Regression turn;
  for (std::size_t i = 0; i < all.size(); i += stride) {
    const Vector3d point = points[all[i]].cast<double>();
    const std::optional<Nearest> nearest = nearest_cylinder(pieces, point);
    if (!nearest) continue;
    // Angles around the axis, from the direction of the sensor.
    const Vector3d side = nearest->along.cross(camera.pose.translation() - point).normalized();
    const Vector3d front = side.cross(nearest->along);
    const Vector3d normal = votes.normals[all[i]].cast<double>();
    turn.add(std::atan2(nearest->way.dot(side), nearest->way.dot(front)),
             std::atan2(normal.dot(side), normal.dot(front)));
  }
  constexpr double points_min = 20;
  constexpr double arc_min = 0.2;  // rad, standard deviation
  if (turn.count < points_min || turn.variance() < arc_min * arc_min) return std::nullopt;
  return turn.slope();
}

}  // namespace tanglebin
