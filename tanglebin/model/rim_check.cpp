#include "tanglebin/model/rim_check.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
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
constexpr double rim_reach = 0.025;      // m, the same where the rim's own height is asked for
constexpr double rim_tolerance = 0.003;  // m

/// Where the rim is at a place along a side, outwards or upwards of where it should be.
struct RimPlace {
  double along;  // m, from the side's middle
  double off;    // m
};

/// The line that the rim follows along a side.
struct RimLine {
  double off;    // m, at the side's middle
  double slope;  // m per m along
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
      if (4 * along > length) slopes.push_back((places[j].off - places[i].off) / along);
    }
  }
  if (slopes.empty()) return std::nullopt;
  const double slope = median(std::move(slopes));
  std::vector<double> values;
  values.reserve(places.size());
  for (const RimPlace& place : places) values.push_back(place.off - slope * place.along);
  const double off = median(values);
  for (double& value : values) value = std::abs(value - off);
  if (median(std::move(values)) > scatter_max) return std::nullopt;
  return RimLine{off, slope};
}

/// The points near a bin's rim at one of its sides.
class RimSide {
public:
  // Sides are 0 to 3: −x, +x, −y, +y.
  RimSide(const Bin& bin, std::size_t side)
      : axis_(side < 2 ? 0 : 1),
        sign_(side % 2 == 0 ? -1 : 1),
        middle_(((side < 2 ? bin.length : bin.width) + bin.wall) / 2),
        half_((side < 2 ? bin.width : bin.length) / 2),
        wall_(bin.wall) {}

  // `height` is that over the rim's, m.
  void see(const Vector3f& point, double height, double level_max) {
    constexpr double reach = 0.06;  // m
    constexpr double aside = 0.01;  // m
    const double outwards = sign_ * static_cast<double>(point[axis_]) - middle_;
    const auto along = static_cast<double>(point[1 - axis_]);
    if (!(std::abs(outwards) <= std::min(reach, middle_ / 2) && std::abs(along) < half_)) return;
    const double share = (along + half_) / (2 * half_);
    const auto place = static_cast<std::size_t>(share * places);
    if (std::abs(height) < level_max) level_.at(place).push_back(outwards);
    if (std::abs(outwards) < wall_ / 2 + aside) heights_.at(place).push_back(height);
  }

  // Of the rim's middle, outwards.
  std::optional<RimLine> line(double margin) const {
    return line_through_places(margin,
                               [&](std::size_t place) { return middle_of_rim(level_[place], margin); });
  }

  // Of the rim's height.
  std::optional<RimLine> height_line(double margin) const {
    return line_through_places(margin, [&](std::size_t place) { return height_of_rim(heights_[place]); });
  }

private:
  static constexpr std::size_t places = 100;

  std::optional<RimLine> line_through_places(double margin, const auto& rim_at) const {
    std::vector<RimPlace> seen;
    seen.reserve(places);
    for (std::size_t place = 0; place < places; ++place) {
      const double along = half_ * (2 * (static_cast<double>(place) + 0.5) / places - 1);
      if (const std::optional<double> off = rim_at(place)) seen.push_back({along, *off});
    }
    constexpr double scatter_max = 0.002;
    return line_through(seen, 2 * half_, scatter_max + margin);
  }

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

  // Below the rim are the sides of the wall: the rim is the highest third. Noise lifts it on all sides alike.
  static std::optional<double> height_of_rim(std::vector<double> heights) {
    constexpr std::size_t points_min = 5;
    if (heights.size() < points_min) return std::nullopt;
    const auto sixth = static_cast<std::ptrdiff_t>(heights.size() / 6);
    std::ranges::nth_element(heights, heights.begin() + sixth, std::greater<>());
    return heights[static_cast<std::size_t>(sixth)];
  }

  Eigen::Index axis_;
  double sign_;
  double middle_;  // m, from the bin's middle to the rim's
  double half_;    // m, of the side's length
  double wall_;
  std::array<std::vector<double>, places> level_;    // of what is level with the rim: m, outwards
  std::array<std::vector<double>, places> heights_;  // m, over the rim's
};

using RimLines = std::array<std::optional<RimLine>, 4>;

/// The rim as it is seen, at each side.
struct SeenRim {
  RimLines lines;
  RimLines height_lines;
};

SeenRim rim_in(const PointCloud& cloud, const Support& support) {
  std::vector<RimSide> sides;
  sides.reserve(4);
  for (std::size_t side = 0; side < 4; ++side) sides.emplace_back(support.bin, side);
  const Eigen::Affine3f to_support = support.pose.inverse(Eigen::Isometry).cast<float>();
  const Eigen::RowVector3f up = to_support.linear().row(2);
  const float offset = to_support.translation().z() - static_cast<float>(support.bin.height);
  const double level_max = rim_level + support.margin;
  // Where walls are low, what lies in the bin is soon as high as the rim.
  const double height_max = std::max(std::min(rim_reach, support.bin.height / 2), level_max);
  for (const Vector3f& point : cloud.points) {
    const double height = up.dot(point) + offset;
    if (!(std::abs(height) < height_max)) continue;
    for (RimSide& side : sides) side.see(to_support * point, height, level_max);
  }
  SeenRim rim;
  for (std::size_t side = 0; side < 4; ++side) {
    rim.lines[side] = sides[side].line(support.margin);
    rim.height_lines[side] = sides[side].height_line(support.margin);
  }
  return rim;
}

double sign_of(std::size_t side) {
  return side % 2 == 0 ? -1 : 1;
}

/// By how much a bin stands beside its place, in its frame.
struct Displacement {
  Vector2d shift = Vector2d::Zero();  // m
  double turn = 0;                    // rad, about z
  Vector2d lean = Vector2d::Zero();   // rad, about x and y
};

// How steeply the rim's height goes up along x and y: from side to side, and along the sides.
Vector2d steepness_of(const RimLines& heights, const Bin& bin) {
  const Vector2d across(bin.length + bin.wall, bin.width + bin.wall);
  Vector2d steepness = Vector2d::Zero();
  for (std::size_t axis = 0; axis < 2; ++axis) {
    std::vector<double> slopes;
    const auto& [low, high] = std::pair(heights[2 * axis], heights[2 * axis + 1]);
    if (low && high) slopes.push_back((high->off - low->off) / across[static_cast<Eigen::Index>(axis)]);
    for (const std::size_t side : {2 - 2 * axis, 3 - 2 * axis}) {
      if (heights[side]) slopes.push_back(heights[side]->slope);
    }
    if (!slopes.empty()) steepness[static_cast<Eigen::Index>(axis)] = median(std::move(slopes));
  }
  return steepness;
}

// A bin that is moved takes both of its sides along; one that is larger puts them apart.
Displacement displacement_of(const SeenRim& rim, const Bin& bin) {
  const RimLines& lines = rim.lines;
  Displacement displacement;
  std::vector<double> turns;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    double sum = 0;
    double count = 0;
    for (const std::size_t side : {2 * axis, 2 * axis + 1}) {
      if (!lines[side]) continue;
      sum += sign_of(side) * lines[side]->off;
      ++count;
      turns.push_back((axis == 0 ? -1 : 1) * sign_of(side) * lines[side]->slope);
    }
    if (count > 0) displacement.shift[static_cast<Eigen::Index>(axis)] = sum / count;
  }
  if (!turns.empty()) displacement.turn = median(std::move(turns));
  const Vector2d steepness = steepness_of(rim.height_lines, bin);
  displacement.lean = {std::atan(steepness.y()), -std::atan(steepness.x())};
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
  const Vector2d across(support.bin.width, support.bin.length);
  for (const Eigen::Index axis : {0, 1}) {
    if (std::abs(displacement.lean[axis]) * across[axis] / 2 <= most) continue;
    words += fmt::format("{}leaning by about {:.1f}° about {}", words.empty() ? "" : " and ",
                         displacement.lean[axis] / degree, "xy"[axis]);
  }
  return words;
}

// The side whose rim is the farthest from its place, if that is more than a wall of another thickness
// explains.
std::optional<std::size_t> side_elsewhere(const RimLines& lines, const Support& support) {
  const double most = std::max(rim_level, support.bin.wall / 2) + support.margin;
  std::optional<std::size_t> farthest;
  for (std::size_t side = 0; side < 4; ++side) {
    if (!lines[side] || std::abs(lines[side]->off) <= most) continue;
    if (!farthest || std::abs(lines[side]->off) > std::abs(lines[*farthest]->off)) farthest = side;
  }
  return farthest;
}

}  // namespace

std::optional<Finding> doubt_of_rim_place(const PointCloud& cloud, const Support& support) {
  const SeenRim rim = rim_in(cloud, support);
  const std::string words = words_of(displacement_of(rim, support.bin), support);
  if (!words.empty()) {
    return Finding{
        Finding::Severity::warning, "bin",
        fmt::format("against the scene, the bin's rim is seen {}: locate it with --locate", words)};
  }
  const std::optional<std::size_t> side = side_elsewhere(rim.lines, support);
  if (!side) return std::nullopt;
  constexpr std::array names{"-x", "+x", "-y", "+y"};
  const double outwards = rim.lines[*side]->off;
  return Finding{
      Finding::Severity::warning, "bin",
      fmt::format("the bin's rim at {} is {:.0f} mm {} of where the scene has it: the bin may have "
                  "another size or pose",
                  names.at(*side), 1000 * std::abs(outwards), outwards > 0 ? "outwards" : "inwards")};
}

}  // namespace tanglebin
