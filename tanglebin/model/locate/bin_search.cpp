#include "tanglebin/model/locate/bin_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <utility>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/model/locate/bin_parts.hpp"

namespace tanglebin {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// A pose with the score of its agreement with the view.
struct Scored {
  Isometry3d pose;
  int score;
};

/// Something seen of the walls, from above.
struct WallPatch {
  Vector2d centre;  // m
  Vector2d normal;
  double weight;  // in points
};

/// What a level floor sees, as maps: coordinates along the floor, m.
struct Plan {
  Isometry3d frame;  // of the maps → camera frame; z up, origin on the floor
  std::vector<Vector2d> rim;
  std::vector<Vector2d> floor;
  std::vector<WallPatch> walls;
};

// A frame with its z along `up` and its origin at this height (m) along it, under the middle of what is seen.
Isometry3d level_frame(const Vector3d& up, double height, const Vector3d& middle) {
  Isometry3d frame;
  const Vector3d x = up.unitOrthogonal();
  frame.linear() << x, up.cross(x), up;
  frame.translation() = middle + (height - up.dot(middle)) * up;
  return frame;
}

Vector3d middle_of(const SensorView& view, const std::vector<std::size_t>& pixels) {
  Vector3d sum = Vector3d::Zero();
  for (const std::size_t pixel : pixels) sum += view.points[pixel].cast<double>();
  return sum / static_cast<double>(pixels.size());
}

Plan plan_of(const SensorView& view, const std::vector<std::size_t>& pixels,
             const std::vector<FlatPatch>& patches, const Isometry3d& frame, const Bin& bin,
             double closeness) {
  constexpr double steep = 0.4;  // largest cosine between a wall's normal and the vertical
  Plan plan{.frame = frame, .rim = {}, .floor = {}, .walls = {}};
  const Isometry3d from_camera = frame.inverse(Eigen::Isometry);
  double patch_area = 0;
  for (const FlatPatch& patch : patches) patch_area += patch.area;
  for (const std::size_t pixel : pixels) {
    const Vector3d point = from_camera * view.points[pixel].cast<double>();
    if (std::abs(point.z() - bin.height) < closeness) plan.rim.emplace_back(point.head<2>());
    if (std::abs(point.z()) < closeness) plan.floor.emplace_back(point.head<2>());
  }
  // A patch stands for as many points as its share of the surface.
  const double points_per_area = static_cast<double>(pixels.size()) / patch_area;
  for (const FlatPatch& patch : patches) {
    const Vector3d normal = from_camera.linear() * patch.normal;
    const Vector3d centre = from_camera * patch.centre;
    if (std::abs(normal.z()) > steep || centre.z() < closeness || centre.z() > bin.height) continue;
    plan.walls.push_back({centre.head<2>(), normal.head<2>().normalized(), patch.area * points_per_area});
  }
  return plan;
}

/// Counts along one direction, in cells.
class Profile {
public:
  Profile(double reach, double cell)
      : reach_(reach), cell_(cell), counts_(static_cast<std::size_t>(2 * reach / cell) + 2, 0.0) {}

  void add(double place, double weight) {
    if (std::abs(place) < reach_) counts_[index_of(place) + 1] += weight;
  }
  // To be called once, after the last add().
  void accumulate() {
    for (std::size_t i = 1; i < counts_.size(); ++i) counts_[i] += counts_[i - 1];
  }
  double between(double low, double high) const { return counts_[index_of(high)] - counts_[index_of(low)]; }

private:
  std::size_t index_of(double place) const {
    const double inside = std::clamp(place + reach_, 0.0, 2 * reach_);
    return std::min(static_cast<std::size_t>(inside / cell_), counts_.size() - 2);
  }

  double reach_;
  double cell_;
  std::vector<double> counts_;  // counts_[i + 1]: of cell i
};

/// What lies along one horizontal direction.
struct Profiles {
  Profile rim;
  Profile floor;
  Profile facing_up;    // walls that face along the direction
  Profile facing_down;  // and against it
};

constexpr double cell = 0.004;  // m

Profiles profiles_of(const Plan& plan, const Vector2d& along, double reach) {
  const Profile empty(reach, cell);
  Profiles profiles{empty, empty, empty, empty};
  constexpr double facing = 0.95;
  for (const Vector2d& point : plan.rim) profiles.rim.add(along.dot(point), 1);
  for (const Vector2d& point : plan.floor) profiles.floor.add(along.dot(point), 1);
  for (const WallPatch& patch : plan.walls) {
    const double cosine = along.dot(patch.normal);
    if (cosine > facing) profiles.facing_up.add(along.dot(patch.centre), patch.weight);
    if (cosine < -facing) profiles.facing_down.add(along.dot(patch.centre), patch.weight);
  }
  for (Profile* profile : {&profiles.rim, &profiles.floor, &profiles.facing_up, &profiles.facing_down})
    profile->accumulate();
  return profiles;
}

// How well two walls with this inner distance fit there.
double fit_at(const Profiles& profiles, double middle, double inner, double wall) {
  const double low = middle - inner / 2;
  const double high = middle + inner / 2;
  const auto near = [](const Profile& profile, double place) {
    return profile.between(place - cell, place + 2 * cell);
  };
  return profiles.rim.between(low - wall, low + cell) + profiles.rim.between(high, high + wall + cell) +
         near(profiles.facing_up, low) + near(profiles.facing_up, high + wall) +
         near(profiles.facing_down, high) + near(profiles.facing_down, low - wall) -
         profiles.floor.between(low - wall, low - cell) - profiles.floor.between(high + cell, high + wall);
}

/// A place along a direction, and how well the walls fit there.
struct Place {
  double middle;  // m
  double fit;
};

// The best place and the best one apart from it.
std::vector<Place> best_places(const Profiles& profiles, double inner, double wall, double reach) {
  constexpr double apart = 0.03;  // m
  std::vector<Place> all;
  const int places = static_cast<int>(std::ceil(2 * reach / cell));
  all.reserve(static_cast<std::size_t>(places));
  for (int i = 0; i < places; ++i) {
    const double middle = i * cell - reach;
    all.push_back({middle, fit_at(profiles, middle, inner, wall)});
  }
  std::ranges::sort(all, [](const Place& a, const Place& b) { return a.fit > b.fit; });
  std::vector<Place> best{all.front()};
  const auto second = std::ranges::find_if(
      all, [&](const Place& place) { return std::abs(place.middle - best.front().middle) > apart; });
  if (second != all.end()) best.push_back(*second);
  return best;
}

/// A pose on a floor, and how well the walls fit there.
struct Placed {
  Isometry3d pose;
  double fit;
};

Isometry3d pose_on(const Plan& plan, double yaw, double x, double y) {
  const Isometry3d turned(Eigen::AngleAxisd(yaw, Vector3d::UnitZ()));
  return plan.frame * turned * Eigen::Translation3d(x, y, 0);
}

double reach_of(const Plan& plan) {
  double reach = 2 * cell;
  for (const Vector2d& point : plan.rim) reach = std::max(reach, point.norm());
  for (const Vector2d& point : plan.floor) reach = std::max(reach, point.norm());
  constexpr double farthest = 10;  // m
  return std::min(reach, farthest);
}

// A bin that is turned by 180° is the same.
std::vector<Placed> places_on(const Plan& plan, const Bin& bin) {
  constexpr int yaws = 120;
  constexpr std::size_t kept = 12;
  constexpr std::size_t kept_beside = 4;  // of the best: a second bin
  const double reach = reach_of(plan);
  std::vector<Placed> placed;
  for (int i = 0; i < yaws; ++i) {
    const double yaw = std::numbers::pi * i / yaws;
    const Vector2d x(std::cos(yaw), std::sin(yaw));
    const Vector2d y(-x.y(), x.x());
    const auto along_x = best_places(profiles_of(plan, x, reach), bin.length, bin.wall, reach);
    const auto along_y = best_places(profiles_of(plan, y, reach), bin.width, bin.wall, reach);
    for (const Place& at_x : along_x) {
      for (const Place& at_y : along_y)
        placed.push_back({pose_on(plan, yaw, at_x.middle, at_y.middle), at_x.fit + at_y.fit});
    }
  }
  std::ranges::stable_sort(placed, [](const Placed& a, const Placed& b) { return a.fit > b.fit; });
  std::vector<Placed> best;
  std::size_t beside = 0;
  for (const Placed& place : placed) {
    const bool is_second = are_beside(bin, place.pose, placed.front().pose) && beside < kept_beside;
    if (best.size() - beside >= kept && !is_second) continue;
    best.push_back(place);
    if (is_second) ++beside;
  }
  return best;
}

// So near that a fit from either ends at the same pose.
bool are_near(const Isometry3d& first, const Isometry3d& second) {
  constexpr double distance = 0.012;  // m
  constexpr double angle = 2 * degree;
  const Isometry3d between = first.inverse(Eigen::Isometry) * second;
  const double turn = Eigen::AngleAxisd(between.linear()).angle();
  return between.translation().norm() < distance && std::min(turn, std::numbers::pi - turn) < angle;
}

// The best ones, without those that are near a better one.
std::vector<Scored> apart(std::vector<Scored> all, std::size_t most) {
  std::ranges::stable_sort(all, [](const Scored& a, const Scored& b) { return a.score > b.score; });
  std::vector<Scored> best;
  for (const Scored& candidate : all) {
    const auto is_near = [&](const Scored& better) { return are_near(better.pose, candidate.pose); };
    if (best.size() < most && std::ranges::none_of(best, is_near)) best.push_back(candidate);
  }
  return best;
}

}  // namespace

std::vector<Isometry3d> possible_poses(const SensorView& view, const std::vector<FlatPatch>& patches,
                                       const std::vector<FlatPlane>& planes, const Bin& bin,
                                       double closeness) {
  constexpr std::size_t points_of_plan = 8000;
  constexpr std::size_t rays = 3000;
  constexpr std::size_t kept_on_plane = 3;
  constexpr std::size_t kept = 12;
  const double most_oblique = std::cos(75 * degree);
  const std::vector<std::size_t> pixels = view.sample(points_of_plan);
  const std::vector<std::size_t> tested = view.sample(rays);
  const Vector3d middle = middle_of(view, pixels);
  std::vector<Scored> scored;
  for (const FlatPlane& plane : planes) {
    if (-plane.normal.dot(middle.normalized()) < most_oblique) continue;
    for (const double height : {plane.offset, plane.offset - bin.height}) {
      const Isometry3d frame = level_frame(plane.normal, height, middle);
      const Plan plan = plan_of(view, pixels, patches, frame, bin, closeness);
      std::vector<Scored> on_plane;
      for (const Placed& placed : places_on(plan, bin))
        on_plane.push_back({placed.pose, score_of(verdicts(view, tested, bin, placed.pose, 2 * closeness))});
      // A table has many places for a floor, which must not crowd out the rim's.
      const std::vector<Scored> best = apart(on_plane, kept_on_plane);
      scored.insert(scored.end(), best.begin(), best.end());
      std::erase_if(on_plane,
                    [&](const Scored& one) { return !are_beside(bin, one.pose, best.front().pose); });
      for (const Scored& second : apart(std::move(on_plane), 1)) scored.push_back(second);
    }
  }
  std::vector<Isometry3d> poses;
  for (const Scored& one : apart(std::move(scored), kept)) poses.push_back(one.pose);
  return poses;
}

}  // namespace tanglebin
