#include "tanglebin/model/axis/fragments/roundness.hpp"

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

// The cylinder's direction is that in which it does not turn back against `forward`.
std::optional<Nearest> nearest_cylinder(const std::vector<Capsule>& capsules, const Vector3d& forward,
                                        const Vector3d& point) {
  std::optional<Nearest> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Capsule& capsule : capsules) {
    const double t = nearest_on_axis(capsule, point);
    const Vector3d way = point - (capsule.a + t * (capsule.b - capsule.a));
    if (way.norm() >= least) continue;
    least = way.norm();
    nearest.reset();
    if (!(t > 0 && t < 1)) continue;
    const Vector3d along = (capsule.b - capsule.a).normalized();
    nearest = Nearest{along.dot(forward) < 0 ? Vector3d(-along) : along, way};
  }
  return nearest;
}

/// Sums of two angles, rad.
struct Angles {
  double count = 0;
  double first = 0, second = 0, squares = 0, products = 0;

  void add(double x, double y) {
    ++count;
    first += x;
    second += y;
    squares += x * x;
    products += x * y;
  }
};

// Angles around the axis, from the direction of the sensor: of the points of a fragment, and of their
// normals.
Angles angles_of(const Fragment& fragment, std::size_t stride, const std::vector<Capsule>& pieces,
                 const std::vector<Eigen::Vector3f>& points, const AxisVotes& votes, const Vector3d& sensor) {
  constexpr double off_max = 0.3;  // radii; what is farther from the side may be on a face
  const double radius = pieces.front().radius;
  const Capsule& longest = *std::ranges::max_element(
      pieces, {}, [](const Capsule& piece) { return (piece.b - piece.a).squaredNorm(); });
  Angles angles;
  for (std::size_t i = 0; i < fragment.points.size(); i += stride) {
    const Vector3d point = points[fragment.points[i]].cast<double>();
    const std::optional<Nearest> nearest = nearest_cylinder(pieces, longest.b - longest.a, point);
    if (!nearest || std::abs(nearest->way.norm() / radius - 1) > off_max) continue;
    const Vector3d side = nearest->along.cross(sensor - point).normalized();
    const Vector3d front = side.cross(nearest->along);
    const Vector3d normal = votes.normals[fragment.points[i]].cast<double>();
    angles.add(std::atan2(nearest->way.dot(side), nearest->way.dot(front)),
               std::atan2(normal.dot(side), normal.dot(front)));
  }
  return angles;
}

}  // namespace

std::optional<double> roundness(const Tube& tube, const std::vector<Fragment>& fragments,
                                const std::vector<std::size_t>& members,
                                const std::vector<Eigen::Vector3f>& points, const AxisVotes& votes,
                                const Camera& camera) {
  std::size_t all = 0;
  for (const std::size_t member : members) all += fragments[member].points.size();
  constexpr std::size_t looked_at = 400;
  const std::size_t stride = all / looked_at + 1;
  const std::vector<Capsule> pieces = capsules(tube);
  if (pieces.empty()) return std::nullopt;
  // The line of the second angle over the first, within the fragments: these may be on different surfaces.
  double count = 0;
  double variance = 0;
  double covariance = 0;
  for (const std::size_t member : members) {
    const Angles angles =
        angles_of(fragments[member], stride, pieces, points, votes, camera.pose.translation());
    if (angles.count == 0) continue;
    count += angles.count;
    variance += angles.squares - angles.first * angles.first / angles.count;
    covariance += angles.products - angles.first * angles.second / angles.count;
  }
  constexpr double points_min = 20;
  constexpr double arc_min = 0.2;  // rad, standard deviation
  if (count < points_min || variance < arc_min * arc_min * count) return std::nullopt;
  return covariance / variance;
}

}  // namespace tanglebin
