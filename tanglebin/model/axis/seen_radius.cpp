#include "tanglebin/model/axis/seen_radius.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tanglebin/base/median.hpp"
#include "tanglebin/geometry/capsule.hpp"
#include "tanglebin/geometry/nearest_axis.hpp"

namespace tanglebin {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Points around the axis of a piece of a tube, m: sideways, and towards the sensor.
using Section = std::vector<Vector2d>;

/// The sections of a tube's pieces. Pieces are about two radii long.
class Sections {
public:
  explicit Sections(const std::vector<Capsule>& capsules) : capsules_(capsules) {
    for (const Capsule& capsule : capsules_) {
      const double pieces = std::max(1.0, std::round((capsule.b - capsule.a).norm() / (2 * capsule.radius)));
      of_capsules_.emplace_back(static_cast<std::size_t>(pieces));
    }
  }

  // Points beyond the ends of a cylinder may be on a cap, a face or the outside of a bend.
  void add(const Vector3d& point, const Foot& foot, const Vector3d& sensor) {
    if (!(foot.t > 0 && foot.t < 1)) return;
    const Capsule& capsule = capsules_[foot.capsule];
    const Vector3d along = (capsule.b - capsule.a).normalized();
    const Vector3d side = along.cross(sensor - point).normalized();
    const Vector3d front = side.cross(along);
    std::vector<Section>& pieces = of_capsules_[foot.capsule];
    const auto piece = static_cast<std::size_t>(foot.t * static_cast<double>(pieces.size()));
    pieces[std::min(piece, pieces.size() - 1)].emplace_back(foot.way.dot(side), foot.way.dot(front));
  }

  const std::vector<std::vector<Section>>& of_capsules() const { return of_capsules_; }

  std::size_t number_of_pieces() const {
    std::size_t sum = 0;
    for (const std::vector<Section>& pieces : of_capsules_) sum += pieces.size();
    return sum;
  }

private:
  const std::vector<Capsule>& capsules_;
  std::vector<std::vector<Section>> of_capsules_;
};

struct Circle {
  Vector2d centre;
  double radius;
};

/// Sums over the points near the front of a circle. Of a point, how far it moves away from the circle where
/// the centre moves sideways by 1 is its slope, and where the radius grows by 1, its growth.
struct Sums {
  double slopes = 0;
  double growths = 0;
  double slopes_squared = 0;
  double slopes_by_growths = 0;
  double growths_squared = 0;
  double residuals = 0;
  double residuals_by_slopes = 0;
  double residuals_by_growths = 0;
  double residuals_squared = 0;
  std::size_t points = 0;
  std::size_t facing = 0;  // with those that are farther from the circle
  double leftmost = 1;     // in radii from the middle
  double rightmost = -1;

  double count() const { return static_cast<double>(points); }
  double noise() const { return std::sqrt(residuals_squared / count()); }

  /// Of the normal equations, for the centre and the radius.
  Matrix3d products() const {
    Matrix3d sums;
    sums << slopes_squared, slopes, slopes_by_growths,  //
        slopes, count(), growths,                       //
        slopes_by_growths, growths, growths_squared;
    return sums;
  }
  Vector3d right_side() const { return {residuals_by_slopes, residuals, residuals_by_growths}; }
};

// What faces away from the sensor by more than 50° does not count: there, sensors blend a tube with what is
// behind it.
Sums sums_over(const Section& section, const Circle& circle, double residual_max) {
  constexpr double aside_max = 0.77;
  Sums sums;
  for (const Vector2d& point : section) {
    const double aside = (point.x() - circle.centre.x()) / circle.radius;
    if (std::abs(aside) > aside_max) continue;
    ++sums.facing;
    const double facing = std::sqrt(1 - aside * aside);
    const double residual = point.y() - circle.centre.y() - circle.radius * facing;
    if (std::abs(residual) > residual_max) continue;
    const double slope = aside / facing;
    const double growth = 1 / facing;
    sums.slopes += slope;
    sums.growths += growth;
    sums.slopes_squared += slope * slope;
    sums.slopes_by_growths += slope * growth;
    sums.growths_squared += growth * growth;
    sums.residuals += residual;
    sums.residuals_by_slopes += residual * slope;
    sums.residuals_by_growths += residual * growth;
    sums.residuals_squared += residual * residual;
    ++sums.points;
    sums.leftmost = std::min(sums.leftmost, aside);
    sums.rightmost = std::max(sums.rightmost, aside);
  }
  return sums;
}

// A small one on the front of the section: it grows as long as points beside it are on the circle too.
std::optional<Circle> first_circle(const Section& section, double known_radius) {
  constexpr double share = 0.35;
  constexpr std::size_t points_min = 5;
  const double radius = share * known_radius;
  std::vector<double> front;
  front.reserve(section.size());
  for (const Vector2d& point : section) {
    if (std::abs(point.x()) < radius / 2) front.push_back(point.y());
  }
  if (front.size() < points_min) return std::nullopt;
  return Circle{{0, median(std::move(front)) - radius}, radius};
}

/// The radius of a piece, and its standard error, m.
struct PieceRadius {
  double radius;
  double error;

  // Errors of thin circles look small: they count as shares of the radius.
  double weight() const { return radius * radius / (error * error); }
};

std::optional<PieceRadius> radius_of(const Section& section, double known_radius) {
  constexpr std::size_t points_min = 10;
  constexpr int iterations = 15;
  constexpr int wide_iterations = 7;    // while the circle grows
  constexpr double residual_max = 0.3;  // known radii
  constexpr double sigmas = 3;
  constexpr double exact = 0.01;     // known radii
  constexpr double settled = 0.001;  // known radii
  constexpr double step_max = 0.4;
  constexpr double factor_max = 5;
  constexpr double arc_min = 1;       // rad
  constexpr double error_min = 0.02;  // radii
  std::optional<Circle> circle = first_circle(section, known_radius);
  if (!circle) return std::nullopt;
  double wanted = residual_max * known_radius;
  Sums sums;
  for (int i = 0; i < iterations; ++i) {
    sums = sums_over(section, *circle, wanted);
    if (sums.points < points_min || 2 * sums.points < sums.facing) return std::nullopt;
    const Vector3d step = sums.products().inverse() * sums.right_side();
    circle->centre += step.head<2>();
    circle->radius *= 1 + std::clamp(step[2] / circle->radius, -step_max, step_max);
    const double factor = circle->radius / known_radius;
    if (!(factor > 1 / factor_max && factor < factor_max)) return std::nullopt;
    if (i > wide_iterations && std::abs(step[2]) < settled * known_radius) break;
    if (i >= wide_iterations)
      wanted = std::min(wanted, std::max(sigmas * sums.noise(), exact * known_radius));
  }
  if (std::asin(sums.rightmost) - std::asin(sums.leftmost) < arc_min) return std::nullopt;
  const double error = sums.noise() * std::sqrt(sums.products().inverse()(2, 2));
  return PieceRadius{circle->radius, std::max(error, error_min * circle->radius)};
}

double weighted_middle(std::vector<PieceRadius>& pieces) {
  std::ranges::sort(pieces, {}, &PieceRadius::radius);
  double left = 0;
  for (const PieceRadius& piece : pieces) left += piece.weight() / 2;
  for (const PieceRadius& piece : pieces) {
    left -= piece.weight();
    if (left <= 0) return piece.radius;
  }
  return pieces.back().radius;
}

// The error is what the pieces' own errors and what their differences say, whichever is more.
SeenRadius middle_of(std::vector<PieceRadius> pieces) {
  const double middle = weighted_middle(pieces);
  std::vector<double> radii;
  radii.reserve(pieces.size());
  double weight = 0;
  for (const PieceRadius& piece : pieces) {
    radii.push_back(piece.radius);
    weight += piece.weight();
  }
  const double deviation = deviation_about(middle, std::move(radii));
  const double from_pieces = deviation / std::sqrt(static_cast<double>(pieces.size()));
  return {middle, std::max(from_pieces, middle / std::sqrt(weight)), pieces.size()};
}

std::vector<PieceRadius> radii_of(const Sections& sections, double known_radius) {
  std::vector<PieceRadius> radii;
  radii.reserve(sections.number_of_pieces());
  for (const std::vector<Section>& of_capsule : sections.of_capsules()) {
    for (const Section& section : of_capsule) {
      if (const std::optional<PieceRadius> radius = radius_of(section, known_radius))
        radii.push_back(*radius);
    }
  }
  return radii;
}

}  // namespace

std::vector<SeenRadius> seen_radii(const Tube& tube, const std::vector<Fragment>& fragments,
                                   const std::vector<std::size_t>& members,
                                   const std::vector<Eigen::Vector3f>& points, const Vector3d& sensor) {
  constexpr std::size_t for_each_piece = 100;
  const std::vector<Capsule> pieces = capsules(tube);
  if (pieces.empty()) return {};
  NearestAxis nearest(pieces);
  const Sections empty(pieces);
  const std::size_t stride =
      number_of_points(fragments, members) / (for_each_piece * empty.number_of_pieces()) + 1;
  std::vector<PieceRadius> all;
  std::vector<SeenRadius> seen;
  seen.reserve(members.size() + 1);
  for (const std::size_t member : members) {
    const std::vector<std::size_t>& own = fragments[member].points;
    Sections sections = empty;
    for (std::size_t i = 0; i < own.size(); i += stride) {
      const Vector3d point = points[own[i]].cast<double>();
      sections.add(point, nearest.foot_of(point), sensor);
    }
    std::vector<PieceRadius> radii = radii_of(sections, tube.radius);
    all.insert(all.end(), radii.begin(), radii.end());
    if (members.size() > 1 && !radii.empty()) seen.push_back(middle_of(std::move(radii)));
  }
  if (!all.empty()) seen.insert(seen.begin(), middle_of(std::move(all)));
  return seen;
}

}  // namespace tanglebin
