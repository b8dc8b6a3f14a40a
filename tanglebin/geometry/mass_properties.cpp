#include "tanglebin/geometry/mass_properties.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/geometry/interval.hpp"

// Each capsule is cut into thin rods parallel to its axis. A rod ends at the capsule's surface and leaves out
// what earlier capsules fill. The ends of the rods are exact, so the quadrature is only over the capsule's
// cross-section. Rods end at the plane of a flat end. With c = √(1 − ρ²/r²), the area element is r² c dc dφ,
// and the moments of a single capsule are polynomials in c, cos φ and sin φ that the rule below integrates
// exactly. Error, compared with twenty-five times as many rods on 200 tubes of each sort: volume and inertia
// within 0.0001 % for the paper's chains and within 0.04 % for trees and chains that fold back on themselves;
// centre within 0.03 mm.

namespace tanglebin {
namespace {

using Rule = boost::math::quadrature::gauss<double, 10>;
constexpr int azimuths = 24;

struct Line {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  // unit
};

Interval intersection(const Interval& a, const Interval& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high)};
}

Interval hull(const Interval& a, const Interval& b) {
  if (a.high < a.low) return b;
  if (b.high < b.low) return a;
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

// The solutions of a t² + 2 b t + c ≤ 0, for a ≥ 0.
Interval below_zero(double a, double b, double c) {
  constexpr double parallel = 1e-12;
  if (a < parallel) return c <= 0 ? Interval{-infinity, infinity} : Interval{};
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return {};
  const double root = std::sqrt(discriminant);
  return {(-b - root) / a, (-b + root) / a};
}

// The part of a line between the planes through a and b perpendicular to a–b.
Interval inside_slab(double slope, double start, double length) {
  if (slope == 0) return start >= 0 && start <= length ? Interval{-infinity, infinity} : Interval{};
  const double at_a = -start / slope;
  const double at_b = (length - start) / slope;
  return {std::min(at_a, at_b), std::max(at_a, at_b)};
}

// A capsule, and what it needs of lines that all have one direction.
class CapsuleAlong {
public:
  CapsuleAlong(const Capsule& capsule, const Eigen::Vector3d& direction)
      : capsule_(capsule), length_((capsule.b - capsule.a).norm()), direction_(direction) {
    if (length_ == 0) return;
    axis_ = (capsule.b - capsule.a) / length_;
    slope_ = direction.dot(axis_);
    across_ = direction - slope_ * axis_;
    steepness_ = across_.squaredNorm();
  }

  // The part of the line inside. A capsule is convex, so it is a single interval, whichever parts of the
  // capsule the line passes.
  Interval of_line(const Eigen::Vector3d& origin) const {
    Interval inside = of_cylinder(origin);
    if (!capsule_.flat_at_a) inside = hull(inside, of_sphere(origin, capsule_.a));
    if (!capsule_.flat_at_b) inside = hull(inside, of_sphere(origin, capsule_.b));
    return inside;
  }

private:
  Interval of_cylinder(const Eigen::Vector3d& origin) const {
    if (length_ == 0) return {};
    const Eigen::Vector3d offset = origin - capsule_.a;
    const double start = offset.dot(axis_);
    const Eigen::Vector3d across_offset = offset - start * axis_;
    return intersection(inside_slab(slope_, start, length_),
                        below_zero(steepness_, across_offset.dot(across_),
                                   across_offset.squaredNorm() - capsule_.radius * capsule_.radius));
  }

  Interval of_sphere(const Eigen::Vector3d& origin, const Eigen::Vector3d& centre) const {
    const Eigen::Vector3d offset = origin - centre;
    return below_zero(1, offset.dot(direction_), offset.squaredNorm() - capsule_.radius * capsule_.radius);
  }

  Capsule capsule_;
  double length_;
  Eigen::Vector3d direction_;
  Eigen::Vector3d axis_ = Eigen::Vector3d::Zero();
  double slope_ = 0;                                  // of the direction along the axis
  Eigen::Vector3d across_ = Eigen::Vector3d::Zero();  // the rest of the direction
  double steepness_ = 0;                              // squared length of that
};

// Volume, with its first and second moments.
struct Moments {
  double volume = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  void add_rod(const Line& line, double low, double high, double area) {
    const double length = high - low;
    const Eigen::Vector3d middle = line.origin + (low + high) / 2 * line.direction;
    volume += area * length;
    first += area * length * middle;
    second +=
        area * length *
        (middle * middle.transpose() + length * length / 12 * line.direction * line.direction.transpose());
  }
};

// Adds the parts of a rod that are in none of the `filled` capsules.
void add_free_parts(const Line& line, const Interval& rod, double area,
                    const std::vector<CapsuleAlong>& filled, std::vector<Interval>& taken, Moments& moments) {
  taken.clear();
  for (const CapsuleAlong& capsule : filled) {
    const Interval inside = intersection(rod, capsule.of_line(line.origin));
    if (inside.low < inside.high) taken.push_back(inside);
  }
  std::ranges::sort(taken, {}, &Interval::low);
  double low = rod.low;
  for (const Interval& part : taken) {
    if (low < part.low) moments.add_rod(line, low, part.low, area);
    low = std::max(low, part.high);
  }
  if (low < rod.high) moments.add_rod(line, low, rod.high, area);
}

// At even steps, in the plane z = 0.
const std::array<Eigen::Vector3d, azimuths>& unit_circle() {
  static const auto circle = [] {
    std::array<Eigen::Vector3d, azimuths> points;
    for (std::size_t i = 0; i < azimuths; ++i) {
      const double phi = 2 * std::numbers::pi * static_cast<double>(i) / azimuths;
      points[i] = {std::cos(phi), std::sin(phi), 0};
    }
    return points;
  }();
  return circle;
}

// Adds the capsule of an edge without the `filled` ones. Moments are about `origin`.
void add_capsule(const EdgeFrame& frame, const Capsule& capsule, const Eigen::Vector3d& origin,
                 const std::vector<Capsule>& filled, Moments& moments) {
  const Eigen::Matrix3d axes = frame.rotation.toRotationMatrix();
  std::vector<CapsuleAlong> filled_along;
  filled_along.reserve(filled.size());
  for (const Capsule& other : filled) filled_along.emplace_back(other, axes.col(2));
  std::vector<Interval> taken;
  const auto add_ring = [&](double c, double weight) {
    const double rho = capsule.radius * std::sqrt(1 - c * c);
    const double half = frame.length / 2;
    const double reach = half + capsule.radius * c;
    const Interval rod{capsule.flat_at_a ? -half : -reach, capsule.flat_at_b ? half : reach};
    const double area = weight * capsule.radius * capsule.radius * c * 2 * std::numbers::pi / azimuths;
    for (const Eigen::Vector3d& outward : unit_circle()) {
      const Eigen::Vector3d across = axes * (rho * outward);
      add_free_parts({frame.centre - origin + across, axes.col(2)}, rod, area, filled_along, taken, moments);
    }
  };
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {  // the rule is on [−1, 1], but c is in [0, 1]
    const double weight = Rule::weights()[i] / 2;
    add_ring((1 - Rule::abscissa()[i]) / 2, weight);
    add_ring((1 + Rule::abscissa()[i]) / 2, weight);
  }
}

}  // namespace

MassProperties mass_properties(const Tube& tube) {
  const Eigen::Vector3d origin = tube.nodes.front().position;  // near the tube, to avoid cancellation
  std::vector<Capsule> all = capsules(tube);
  for (Capsule& capsule : all) {
    capsule.a -= origin;
    capsule.b -= origin;
  }

  Moments moments;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<Capsule> filled;
    std::copy_if(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i), std::back_inserter(filled),
                 [&](const Capsule& earlier) { return surface_distance(earlier, all[i]) < 0; });
    add_capsule(frame_of(tube, tube.edges[i]), all[i], origin, filled, moments);
  }

  const Eigen::Vector3d centre = moments.first / moments.volume;
  const Eigen::Matrix3d spread = moments.second / moments.volume - centre * centre.transpose();
  const Eigen::Matrix3d inertia = tube.mass * (spread.trace() * Eigen::Matrix3d::Identity() - spread);
  return {tube.mass, moments.volume, origin + centre, (inertia + inertia.transpose()) / 2};
}

}  // namespace tanglebin
