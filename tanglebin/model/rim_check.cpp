#include "tanglebin/model/rim_check.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/median.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

constexpr double rim_level = 0.005;      // m, from the rim's height, of its points
constexpr double rim_tolerance = 0.003;  // m

/// Where the middle of the rim is at a place along a side.
struct RimPlace {
  double along;     // m, from the side's middle
  double outwards;  // m, from where it should be
};

/// The line that the middle of the rim follows along a side.
struct RimLine {
  double outwards;  // m, at the side's middle
  double slope;     // m outwards per m along
};

// The line through the places, in spite of tubes that lie over some of them (Theil and Sen).
std::optional<RimLine> line_through(const std::vector<RimPlace>& places, double length, double scatter_max) {
  constexpr std::size_t places_min = 30;
  if (places.size() < places_min) return std::nullopt;
  std::vector<double> slopes;
  slopes.reserve(places.size() * places.size() / 2);
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = i + 1; j < places.size(); ++j) {
      const double along = places[j].along - places[i].along;
      if (4 * along > length) slopes.push_back((places[j].outwards - places[i].outwards) / along);
    }
  }
  if (slopes.empty()) return std::nullopt;
  const double slope = median(std::move(slopes));
  std::vector<double> values;
  values.reserve(places.size());
  for (const RimPlace& place : places) values.push_back(place.outwards - slope * place.along);
  const double outwards = median(values);
  for (double& value : values) value = std::abs(value - outwards);
  if (median(std::move(values)) > scatter_max) return std::nullopt;
  return RimLine{outwards, slope};
}

/// The points level with a bin's rim near one of its sides.
class RimSide {
public:
  // Sides are 0 to 3: −x, +x, −y, +y.
  RimSide(const Bin& bin, std::size_t side)
      : axis_(side < 2 ? 0 : 1),
        sign_(side % 2 == 0 ? -1 : 1),
        middle_(((side < 2 ? bin.length : bin.width) + bin.wall) / 2),
        half_((side < 2 ? bin.width : bin.length) / 2),
        wall_(bin.wall) {}

  void see(const Vector3f& point) {
    constexpr double reach = 0.06;  // m
    const double outwards = sign_ * static_cast<double>(point[axis_]) - middle_;
    const auto along = static_cast<double>(point[1 - axis_]);
    if (!(std::abs(outwards) <= std::min(reach, middle_ / 2) && std::abs(along) < half_)) return;
    const double share = (along + half_) / (2 * half_);
    seen_.at(static_cast<std::size_t>(share * places)).push_back(outwards);
  }

  std::optional<RimLine> line(double margin) const {
    std::vector<RimPlace> middles;
    middles.reserve(places);
    for (std::size_t place = 0; place < places; ++place) {
      const double along = half_ * (2 * (static_cast<double>(place) + 0.5) / places - 1);
      if (const auto outwards = middle_of_rim(seen_[place], margin)) middles.push_back({along, *outwards});
    }
    constexpr double scatter_max = 0.002;
    return line_through(middles, 2 * half_, scatter_max + margin);
  }

private:
  static constexpr std::size_t places = 100;

  // Of points side by side that are about as wide together as the wall; of several such, the nearest. The
  // sides of the wall, if they are seen, are at the ends and do not matter.
  std::optional<double> middle_of_rim(std::vector<double> points, double margin) const {
    constexpr double gap_min = 0.004;
    constexpr double width_tolerance = 0.002;
    const double gap = std::max(gap_min, wall_ / 2);
    std::ranges::sort(points);
    std::optional<double> nearest;
    for (auto first = points.begin(); first != points.end();) {
      const auto wide =
          std::adjacent_find(first, points.end(), [&](double a, double b) { return b - a > gap; });
      const auto end = wide == points.end() ? wide : wide + 1;
      const double width = *(end - 1) - *first;
      const double middle = (*first + *(end - 1)) / 2;
      if (std::abs(width - wall_) < wall_ / 2 + width_tolerance + margin &&
          (!nearest || std::abs(middle) < std::abs(*nearest)))
        nearest = middle;
      first = end;
    }
    return nearest;
  }

  Eigen::Index axis_;
  double sign_;
  double middle_;  // m, from the bin's middle to the rim's
  double half_;    // m, of the side's length
  double wall_;
  std::array<std::vector<double>, places> seen_;  // m, outwards of the rim's middle
};

using RimLines = std::array<std::optional<RimLine>, 4>;

RimLines lines_in(const PointCloud& cloud, const Support& support) {
  std::vector<RimSide> sides;
  sides.reserve(4);
  for (std::size_t side = 0; side < 4; ++side) sides.emplace_back(support.bin, side);
  const Eigen::Affine3f to_support = support.pose.inverse(Eigen::Isometry).cast<float>();
  const Eigen::RowVector3f up = to_support.linear().row(2);
  const float offset = to_support.translation().z() - static_cast<float>(support.bin.height);
  const auto level_max = static_cast<float>(rim_level + support.margin);
  for (const Vector3f& point : cloud.points) {
    if (!(std::abs(up.dot(point) + offset) < level_max)) continue;
    for (RimSide& side : sides) side.see(to_support * point);
  }
  RimLines lines;
  for (std::size_t side = 0; side < 4; ++side) lines[side] = sides[side].line(support.margin);
  return lines;
}

double sign_of(std::size_t side) {
  return side % 2 == 0 ? -1 : 1;
}

/// By how much a bin stands beside its place, in its frame.
struct Displacement {
  Vector2d shift = Vector2d::Zero();  // m
  double turn = 0;                    // rad, about z
};

// A bin that is moved takes both of its sides along; one that is larger puts them apart.
Displacement displacement_of(const RimLines& lines) {
  Displacement displacement;
  std::vector<double> turns;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    double sum = 0;
    double count = 0;
    for (const std::size_t side : {2 * axis, 2 * axis + 1}) {
      if (!lines[side]) continue;
      sum += sign_of(side) * lines[side]->outwards;
      ++count;
      turns.push_back((axis == 0 ? -1 : 1) * sign_of(side) * lines[side]->slope);
    }
    if (count > 0) displacement.shift[static_cast<Eigen::Index>(axis)] = sum / count;
  }
  if (!turns.empty()) displacement.turn = median(std::move(turns));
  return displacement;
}

std::string words_of_shift(const Vector2d& shift) {
  constexpr double least = 0.0015;
  std::string words;
  for (const Eigen::Index axis : {0, 1}) {
    if (std::abs(shift[axis]) < least) continue;
    words += fmt::format("{}{:.0f} mm further in {}{}", words.empty() ? "" : " and ",
                         1000 * std::abs(shift[axis]), shift[axis] > 0 ? '+' : '-', "xy"[axis]);
  }
  return words;
}

// "about 7 mm further in +x and turned by about 2.0° about z"; empty if it is where it should be.
std::string words_of(const Displacement& displacement, const Support& support) {
  const double most = rim_tolerance + support.margin;
  std::string words;
  if (displacement.shift.norm() > most) words = "about " + words_of_shift(displacement.shift);
  if (std::abs(displacement.turn) * support.bin.length / 2 > most) {
    words += fmt::format("{}turned by about {:.1f}° about z", words.empty() ? "" : " and ",
                         displacement.turn / degree);
  }
  return words;
}

// The side whose rim is the farthest from its place, if that is more than a wall of another thickness
// explains.
std::optional<std::size_t> side_elsewhere(const RimLines& lines, const Support& support) {
  const double most = std::max(rim_level, support.bin.wall / 2) + support.margin;
  std::optional<std::size_t> farthest;
  for (std::size_t side = 0; side < 4; ++side) {
    if (!lines[side] || std::abs(lines[side]->outwards) <= most) continue;
    if (!farthest || std::abs(lines[side]->outwards) > std::abs(lines[*farthest]->outwards)) farthest = side;
  }
  return farthest;
}

}  // namespace

std::optional<Finding> doubt_of_rim_place(const PointCloud& cloud, const Support& support) {
  const RimLines lines = lines_in(cloud, support);
  const std::string words = words_of(displacement_of(lines), support);
  if (!words.empty()) {
    return Finding{
        Finding::Severity::warning, "bin",
        fmt::format("against the scene, the bin's rim is seen {}: locate it with --locate", words)};
  }
  const std::optional<std::size_t> side = side_elsewhere(lines, support);
  if (!side) return std::nullopt;
  constexpr std::array names{"-x", "+x", "-y", "+y"};
  const double outwards = lines[*side]->outwards;
  return Finding{
      Finding::Severity::warning, "bin",
      fmt::format("the bin's rim at {} is {:.0f} mm {} of where the scene has it: the bin may have "
                  "another size or pose",
                  names.at(*side), 1000 * std::abs(outwards), outwards > 0 ? "outwards" : "inwards")};
}

}  // namespace tanglebin
