#include "tanglebin/model/axis/fragments/tube_surface.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "tanglebin/base/median.hpp"
#include "tanglebin/geometry/capsule.hpp"
#include "tanglebin/geometry/nearest_axis.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3d;

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

/// Where a point is around the axis.
struct Place {
  double angle;     // rad, from the direction of the sensor
  double distance;  // m, from the axis
  double facing;    // cosine between the normal and the direction of the sensor
};

/// Of the points of a fragment.
struct Measured {
  Angles angles;  // around the axis, from the direction of the sensor: of points and normals
  std::vector<Place> places;
};

Measured measure(const Fragment& fragment, std::size_t stride, const std::vector<Capsule>& pieces,
                 NearestAxis& nearest, const std::vector<Eigen::Vector3f>& points, const AxisVotes& votes,
                 const Vector3d& sensor) {
  constexpr double off_max = 0.3;    // radii; what is farther from the side may be on a face
  constexpr double along_max = 0.5;  // a normal that has more of the axis may be a face's
  const double radius = pieces.front().radius;
  const Capsule& longest = *std::ranges::max_element(
      pieces, {}, [](const Capsule& piece) { return (piece.b - piece.a).squaredNorm(); });
  const Vector3d forward = longest.b - longest.a;
  Measured measured;
  for (std::size_t i = 0; i < fragment.points.size(); i += stride) {
    const Vector3d point = points[fragment.points[i]].cast<double>();
    const Foot foot = nearest.foot_of(point);
    if (!(foot.t > 0 && foot.t < 1) || std::abs(foot.way.norm() / radius - 1) > off_max) continue;
    const Capsule& piece = pieces[foot.capsule];
    const Vector3d direction = (piece.b - piece.a).normalized();
    const Vector3d along = direction.dot(forward) < 0 ? Vector3d(-direction) : direction;
    const Vector3d side = along.cross(sensor - point).normalized();
    const Vector3d front = side.cross(along);
    const Vector3d normal = votes.normals[fragment.points[i]].cast<double>();
    const double angle = std::atan2(foot.way.dot(side), foot.way.dot(front));
    if (std::abs(normal.dot(along)) < along_max)
      measured.angles.add(angle, std::atan2(normal.dot(side), normal.dot(front)));
    measured.places.push_back({angle, foot.way.norm(), normal.dot(front)});
  }
  return measured;
}

// With fewer points, nothing is known.
constexpr std::size_t points_min = 20;

double median_of(const std::vector<Place>& places, double Place::*value) {
  std::vector<double> values;
  values.reserve(places.size());
  for (const Place& place : places) values.push_back(place.*value);
  return median(std::move(values));
}

// The median difference from the middle.
double scatter_about(double middle, const std::vector<Place>& places) {
  std::vector<double> differences;
  differences.reserve(places.size());
  for (const Place& place : places) differences.push_back(std::abs(place.distance - middle));
  return median(std::move(differences));
}

// Those farther than three standard deviations from the middle are of neighbours.
std::vector<Place> without_outliers(std::vector<Place> places, double middle, double scatter) {
  constexpr double deviations = 3;
  std::erase_if(places, [&](const Place& place) {
    return std::abs(place.distance - middle) > deviations * deviation_of_median * scatter;
  });
  return places;
}

// The sum of squares that is left of the values after a least squares fit of the columns.
double left_after(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  const Eigen::VectorXd fitted = columns.householderQr().solve(values);
  return (values - columns * fitted).squaredNorm();
}

// Of the fit of a + b cos φ + c sin φ + d cos 2φ + e sin 2φ, what the last two terms are for.
double ovality_of(const std::vector<Place>& places, double radius) {
  Eigen::MatrixXd terms(static_cast<Eigen::Index>(places.size()), 5);
  Eigen::VectorXd distances(terms.rows());
  for (Eigen::Index i = 0; i < terms.rows(); ++i) {
    const auto& [angle, distance, facing] = places[static_cast<std::size_t>(i)];
    terms.row(i) << 1, std::cos(angle), std::sin(angle), std::cos(2 * angle), std::sin(2 * angle);
    distances(i) = distance;
  }
  constexpr double exact = 0.01;  // radii
  const double left = left_after(terms.leftCols(3), distances);
  if (left < exact * exact * radius * radius * static_cast<double>(places.size())) return 0;
  return 1 - left_after(terms, distances) / left;
}

// By how much the normals of a tube turn, as a share of what they would without a reach, rad, over which they
// are means. Of an arc of ± `arc`, rad, each normal is that of the middle of what lies in its reach.
double smoothed_slope(double arc, double reach) {
  const double cut = std::min(1 - reach / arc, 1.0);  // from here on, the arc's end cuts the reach
  if (cut <= -1) return 0;
  const double whole = cut > 0 ? std::pow(cut, 3) : 0;
  const double inner = std::abs(cut);
  return whole + (1 - std::pow(inner, 3)) / 2 + 3 * cut * (1 - inner * inner) / 4;
}

/// By how much normals turn with the angle around the axis.
struct Turning {
  std::optional<double> slope{};
  double of_a_tube = 1;
};

// The slope of the second angle over the first, within the fragments: these may be on different surfaces. The
// normals are means over a reach, rad.
Turning turning_of(const std::vector<Angles>& of_fragments, double reach) {
  double count = 0;
  double variance = 0;
  double covariance = 0;
  for (const Angles& angles : of_fragments) {
    if (angles.count == 0) continue;
    count += angles.count;
    variance += angles.squares - angles.first * angles.first / angles.count;
    covariance += angles.products - angles.first * angles.second / angles.count;
  }
  constexpr double arc_min = 0.2;  // rad, standard deviation
  if (variance < arc_min * arc_min * count) return {};
  return {covariance / variance, smoothed_slope(std::sqrt(3 * variance / count), reach)};
}

}  // namespace

TubeSurface surface_of(const Tube& tube, const std::vector<Fragment>& fragments,
                       const std::vector<std::size_t>& members, const std::vector<Eigen::Vector3f>& points,
                       const AxisVotes& votes, const Camera& camera) {
  constexpr std::size_t looked_at = 400;
  const std::size_t stride = number_of_points(fragments, members) / looked_at + 1;
  const std::vector<Capsule> pieces = capsules(tube);
  if (pieces.empty()) return {};
  NearestAxis nearest(pieces);
  std::vector<Angles> angles;
  std::vector<Place> places;
  for (const std::size_t member : members) {
    const Measured measured =
        measure(fragments[member], stride, pieces, nearest, points, votes, camera.pose.translation());
    angles.push_back(measured.angles);
    places.insert(places.end(), measured.places.begin(), measured.places.end());
  }
  if (places.size() < points_min) return {};
  const double middle = median_of(places, &Place::distance);
  const double scatter = scatter_about(middle, places);
  const double facing = median_of(places, &Place::facing);
  const Turning turning = turning_of(angles, votes.reach / tube.radius);
  return {turning.slope, turning.of_a_tube, scatter,
          ovality_of(without_outliers(std::move(places), middle, scatter), tube.radius), facing};
}

}  // namespace tanglebin
