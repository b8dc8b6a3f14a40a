#include "tanglebin/model/locate/locate.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/error.hpp"
#include "tanglebin/base/median.hpp"
#include "tanglebin/base/text.hpp"
#include "tanglebin/model/locate/bin_fit.hpp"
#include "tanglebin/model/locate/bin_parts.hpp"
#include "tanglebin/model/locate/bin_search.hpp"
#include "tanglebin/model/locate/patches.hpp"
#include "tanglebin/model/locate/plane_fit.hpp"
#include "tanglebin/model/locate/sensor_view.hpp"

namespace tanglebin {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t rays = 8000;  // for an agreement

[[noreturn]] void refuse(const std::string& problem, const char* field = "support") {
  throw InputError({.file = "", .line = 0, .field = field}, "not located: " + problem);
}

/// What all steps know.
struct Task {
  const SensorView& view;
  BinToFit known;
  std::vector<std::size_t> pixels;  // all over the image, with a point or without
};

std::vector<std::size_t> pixels_of_image(const SensorView& view) {
  const std::size_t stride = (view.points.size() / (4 * rays)) | 1U;
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; i < view.points.size(); i += stride) pixels.push_back(i);
  return pixels;
}

/// A pose of the bin, and what the view says of it.
struct Candidate {
  Isometry3d pose;  // bin frame → camera frame
  std::vector<PixelVerdict> verdicts;
  int score;
};

Candidate candidate_at(const Task& task, const Bin& bin, const Isometry3d& pose) {
  std::vector<PixelVerdict> said = verdicts(task.view, task.pixels, bin, pose, closeness_of(task.known));
  const int score = score_of(said);
  return {pose, std::move(said), score};
}

// By what one pose of a bin differs from another, up to the turns that leave the bin as it is.
struct Difference {
  double distance;  // m
  double angle;     // rad
};

bool is_square(const Bin& bin) {
  constexpr double same = 1e-4;
  return std::abs(bin.length - bin.width) < same;
}

std::vector<Isometry3d> same_poses(const Bin& bin, const Isometry3d& pose) {
  const int count = is_square(bin) ? 4 : 2;
  std::vector<Isometry3d> poses;
  poses.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double turn = 2 * std::numbers::pi * i / count;
    poses.push_back(pose * Eigen::AngleAxisd(turn, Vector3d::UnitZ()));
  }
  return poses;
}

double angle_between_poses(const Isometry3d& first, const Isometry3d& second) {
  return Eigen::AngleAxisd(first.linear().transpose() * second.linear()).angle();
}

Isometry3d nearest_of_same(const Bin& bin, const Isometry3d& pose, const Isometry3d& guess) {
  const std::vector<Isometry3d> poses = same_poses(bin, pose);
  return *std::ranges::min_element(poses, [&](const Isometry3d& a, const Isometry3d& b) {
    return angle_between_poses(guess, a) < angle_between_poses(guess, b);
  });
}

Difference difference(const Bin& bin, const Isometry3d& first, const Isometry3d& second) {
  return {(first.translation() - second.translation()).norm(),
          angle_between_poses(first, nearest_of_same(bin, second, first))};
}

// The candidates after a rough fit, the best first.
std::vector<Candidate> candidates_of(const Task& task, const std::vector<Isometry3d>& poses) {
  std::vector<Candidate> candidates;
  candidates.reserve(poses.size());
  for (const Isometry3d& pose : poses)
    candidates.push_back(candidate_at(task, task.known.bin, moved_near(task.view, task.known, pose)));
  std::ranges::stable_sort(candidates,
                           [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  return candidates;
}

int total(const std::array<int, part_count>& counts) {
  return std::accumulate(counts.begin(), counts.end(), 0);
}

double percent(int part, int whole) {
  return whole == 0 ? 0 : 100.0 * part / whole;
}

/// The pixels in which a wall should be seen: its rim and its sides.
struct WallCounts {
  int expected = 0;
  int explained = 0;
  int hidden = 0;
  int contradicted = 0;
};

WallCounts counts_of_wall(const Agreement& agreement, std::size_t wall, bool only_rim) {
  WallCounts counts;
  for (const PartKind kind : {PartKind::rim, PartKind::inner, PartKind::outer}) {
    if (only_rim && kind != PartKind::rim) continue;
    const std::size_t part = part_of(kind, wall);
    counts.expected += agreement.expected.at(part);
    counts.explained += agreement.explained.at(part);
    counts.hidden += agreement.hidden.at(part);
    counts.contradicted += agreement.contradicted.at(part);
  }
  return counts;
}

// A wall counts as seen where its rim or its sides are.
bool is_seen(const Agreement& agreement, std::size_t wall) {
  constexpr double contradicted_max = 0.6;  // of the rim, which nothing can be seen through
  const std::size_t rim = part_of(PartKind::rim, wall);
  if (agreement.contradicted.at(rim) > contradicted_max * agreement.expected.at(rim)) return false;
  constexpr int least = 8;
  constexpr double share = 0.1;
  return std::ranges::any_of(std::array{PartKind::rim, PartKind::inner, PartKind::outer}, [&](PartKind kind) {
    const std::size_t part = part_of(kind, wall);
    const int explained = agreement.explained.at(part);
    return explained >= least && explained > share * agreement.expected.at(part);
  });
}

// Whether a wall that was not seen could not be: it is not in the image, or hidden.
bool is_excused(const Agreement& agreement, std::size_t wall) {
  constexpr int few = 5;
  const WallCounts counts = counts_of_wall(agreement, wall, false);
  return counts.expected < few || 2 * counts.hidden > counts.expected;
}

std::string walls_seen(const Agreement& agreement) {
  int seen = 0;
  for (std::size_t wall = 0; wall < 4; ++wall) seen += is_seen(agreement, wall) ? 1 : 0;
  return fmt::format("{} of 4 walls are seen", seen);
}

using Fault = std::optional<std::string>;

Fault fault_of_walls(const Agreement& agreement) {
  for (std::size_t wall = 0; wall < 4; ++wall) {
    if (is_seen(agreement, wall) || is_excused(agreement, wall)) continue;
    const WallCounts counts = counts_of_wall(agreement, wall, false);
    return fmt::format(
        "{}; {} is not where the sizes have it: of its pixels, {:.0f} % show it, {:.0f} % something behind "
        "it and {:.0f} % nothing",
        walls_seen(agreement), name_of_wall(wall), percent(counts.explained, counts.expected),
        percent(counts.contradicted, counts.expected),
        percent(counts.expected - counts.explained - counts.contradicted - counts.hidden, counts.expected));
  }
  return std::nullopt;
}

// The rim is what tubes hide least of a bin.
Fault fault_of_rim(const Agreement& agreement, const Bin& bin) {
  constexpr double explained_min = 0.25;
  constexpr double contradicted_max = 0.3;
  WallCounts all;
  for (std::size_t wall = 0; wall < 4; ++wall) {
    const WallCounts counts = counts_of_wall(agreement, wall, true);
    all.expected += counts.expected;
    all.explained += counts.explained;
    all.hidden += counts.hidden;
    all.contradicted += counts.contradicted;
  }
  if (all.explained >= explained_min * all.expected && all.contradicted <= contradicted_max * all.expected)
    return std::nullopt;
  constexpr double shown_min = 0.05;
  constexpr double empty_max = 0.6;
  const int empty = all.expected - all.explained - all.hidden - all.contradicted;
  if (all.explained < shown_min * all.expected && empty > empty_max * all.expected)
    return fmt::format(
        "the rim is not in the cloud where the sizes have it: of its pixels, {:.0f} % show it and {:.0f} % "
        "have no point; was the cloud cropped to the inside of the bin? Leave the rim in it, or give the "
        "bin's pose and do not locate it",
        percent(all.explained, all.expected), percent(empty, all.expected));
  return fmt::format(
      "the rim is not {:.3f} m above the floor, or not {:.3f} m thick: of its pixels, {:.0f} % show it, "
      "{:.0f} % something in front of it and {:.0f} % something behind it",
      bin.height, bin.wall, percent(all.explained, all.expected), percent(all.hidden, all.expected),
      percent(all.contradicted, all.expected));
}

// A box under a table, or on its side there, has a side or its rim in the table, and nothing of its inside is
// seen.
Fault fault_of_inside(const Agreement& agreement) {
  constexpr double expected_min = 0.2;
  constexpr double explained_min = 0.02;
  int expected = agreement.expected[0];
  int explained = agreement.explained[0];
  for (std::size_t wall = 0; wall < 4; ++wall) {
    expected += agreement.expected.at(part_of(PartKind::inner, wall));
    explained += agreement.explained.at(part_of(PartKind::inner, wall));
  }
  if (expected >= expected_min * total(agreement.expected) && explained >= explained_min * expected)
    return std::nullopt;
  return fmt::format("of the best place for this bin, {:.1f} % of its inside is seen",
                     percent(explained, expected));
}

// Why a bin cannot be there.
Fault fault_of(const Agreement& agreement, const Bin& bin) {
  constexpr double contradicted_max = 20;  // percent
  const int measured = total(agreement.explained) + total(agreement.hidden) + total(agreement.contradicted);
  const double contradicted = percent(total(agreement.contradicted), measured);
  if (contradicted > contradicted_max) {
    return fmt::format(
        "in the best pose of this bin, {:.0f} % of the points are behind it and {:.0f} % on it; is it {:.3f} "
        "x {:.3f} x {:.3f} m inside, from wall to wall?",
        contradicted, percent(total(agreement.explained), measured), bin.length, bin.width, bin.height);
  }
  if (Fault fault = fault_of_inside(agreement)) return fault;
  if (Fault fault = fault_of_rim(agreement, bin)) return fault;
  return fault_of_walls(agreement);
}

bool is_possible(const Candidate& candidate, const Bin& bin) {
  return !fault_of(agreement_of(candidate.verdicts), bin);
}

// The largest standard deviation of a corner of the bin, m.
double corner_sd(const Bin& bin, const Eigen::Matrix<double, 6, 6>& covariance) {
  double largest = 0;
  for (const double x : {-bin.length / 2, bin.length / 2}) {
    for (const double y : {-bin.width / 2, bin.width / 2}) {
      Eigen::Matrix<double, 3, 6> moves;
      const Vector3d corner(x, y, bin.height);
      for (int i = 0; i < 3; ++i) {
        moves.col(i) = Vector3d::Unit(i);
        moves.col(i + 3) = Vector3d::Unit(i).cross(corner);
      }
      const Matrix3d spread = moves * covariance * moves.transpose();
      largest = std::max(largest, std::sqrt(spread.diagonal().maxCoeff()));
    }
  }
  return largest;
}

bool is_determined(const Bin& bin, const BinFit& fit) {
  constexpr double largest = 0.005;  // m
  return corner_sd(bin, fit.covariance) <= largest;
}

// What a pixel says of rim and walls. A floor alone may be a table.
int value_of_structure(const PixelVerdict& pixel) {
  const bool is_floor = pixel.part && kind_of_part(*pixel.part) == PartKind::floor;
  return is_floor && pixel.verdict == Verdict::explained ? 0 : value_of(pixel.verdict);
}

// By how much the first is better where it is better.
int advantage(const Candidate& first, const Candidate& second) {
  int sum = 0;
  for (std::size_t i = 0; i < first.verdicts.size(); ++i)
    sum += std::max(0, value_of_structure(first.verdicts[i]) - value_of_structure(second.verdicts[i]));
  return sum;
}

/// A bin fitted to the view, and what the view says of it with the sizes that it has there.
struct Fitted {
  BinFit fit;
  Candidate seen;
};

Fitted fitted_near(const Task& task, const Candidate& candidate) {
  BinFit fit = fit_bin(task.view, task.known, candidate.pose);
  Candidate seen = candidate_at(task, fit.sizes, fit.pose);
  return {std::move(fit), std::move(seen)};
}

constexpr int few_pixels = 8;

// Whether a part is seen where nothing hides it.
bool is_shown(const Agreement& agreement, std::size_t part) {
  constexpr double share = 0.5;
  const int open = agreement.expected.at(part) - agreement.hidden.at(part);
  const int explained = agreement.explained.at(part);
  return explained >= few_pixels && explained >= share * open;
}

bool is_inner_side_shown(const Agreement& agreement, std::size_t wall) {
  const std::size_t part = part_of(PartKind::inner, wall);
  return is_shown(agreement, part) && 2 * agreement.hidden.at(part) < agreement.expected.at(part);
}

// A rim that was not measured is made up for by the inner side of its wall.
bool is_rim_missing(const Agreement& agreement, std::size_t wall) {
  constexpr double contradicted_max = 0.3;
  const std::size_t rim = part_of(PartKind::rim, wall);
  const int expected = agreement.expected.at(rim);
  if (expected - agreement.hidden.at(rim) < few_pixels || is_shown(agreement, rim)) return false;
  return agreement.contradicted.at(rim) > contradicted_max * expected ||
         !is_inner_side_shown(agreement, wall);
}

Fault fault_of_sides(const Agreement& agreement) {
  for (std::size_t wall = 0; wall < 4; ++wall) {
    if (!is_rim_missing(agreement, wall)) continue;
    const WallCounts rim = counts_of_wall(agreement, wall, true);
    return fmt::format(
        "the rim of {} is not where the sizes have it: of its pixels, {:.0f} % show it, {:.0f} % "
        "something in front of it, {:.0f} % something behind it and {:.0f} % nothing",
        name_of_wall(wall), percent(rim.explained, rim.expected), percent(rim.hidden, rim.expected),
        percent(rim.contradicted, rim.expected),
        percent(rim.expected - rim.explained - rim.hidden - rim.contradicted, rim.expected));
  }
  return std::nullopt;
}

double share_of_rim_in_image(const Task& task, const BinFit& fit) {
  constexpr int steps = 100;
  const Vector3d corner((fit.sizes.length + fit.sizes.wall) / 2, (fit.sizes.width + fit.sizes.wall) / 2,
                        fit.sizes.height);
  int in_image = 0;
  for (int i = 0; i < steps; ++i) {
    const double along = 2 * (i + 0.5) / steps - 1;
    for (const Vector3d& place :
         {Vector3d(along, -1, 1), Vector3d(along, 1, 1), Vector3d(-1, along, 1), Vector3d(1, along, 1)})
      in_image += pixel_of(task.view.camera, fit.pose * place.cwiseProduct(corner)) ? 1 : 0;
  }
  return in_image / (4.0 * steps);
}

// A small part of the rim may be anything straight, unless the walls under it are seen too.
Fault fault_of_image(const Task& task, const BinFit& fit, const Agreement& agreement) {
  constexpr double in_image_min = 0.4;
  const double in_image = share_of_rim_in_image(task, fit);
  const auto is_seen_inside = [&](std::size_t wall) { return is_inner_side_shown(agreement, wall); };
  const bool are_walls_shown =
      (is_seen_inside(0) || is_seen_inside(1)) && (is_seen_inside(2) || is_seen_inside(3));
  if (in_image >= in_image_min || are_walls_shown) return std::nullopt;
  return fmt::format(
      "in the best pose of this bin, {:.0f} % of its rim is in the image, and too little of its walls "
      "is seen",
      100 * in_image);
}

// Where a ray to a point passes the plane of the rim, along the floor from the bin's middle, m.
Vector3d crossing_of_rim(const Isometry3d& from_camera, const Vector3d& point, double height) {
  const Vector3d camera = from_camera.translation();
  const Vector3d to_point = from_camera * point - camera;
  return camera + (height - camera.z()) / to_point.z() * to_point;
}

// Of the points that are seen through the bin's opening beside its rim, the share that is level with it.
double level_share(const Task& task, const Fitted& found) {
  constexpr double border = 0.1;  // of the bin's width
  const Bin& bin = found.fit.sizes;
  const Isometry3d from_camera = found.fit.pose.inverse(Eigen::Isometry);
  int beside = 0;
  int level = 0;
  for (std::size_t i = 0; i < task.pixels.size(); ++i) {
    const auto& [part, verdict] = found.seen.verdicts[i];
    if (!part || verdict == Verdict::none) continue;
    const Vector3d point = task.view.points[task.pixels[i]].cast<double>();
    const Vector3d opening = crossing_of_rim(from_camera, point, bin.height);
    const double inset =
        std::min(bin.length / 2 - std::abs(opening.x()), bin.width / 2 - std::abs(opening.y()));
    if (inset < 0 || inset > border * bin.width) continue;
    ++beside;
    const double above_rim = (from_camera * point).z() - bin.height;
    if (verdict == Verdict::hidden && std::abs(above_rim) < closeness_of(task.known)) ++level;
  }
  return beside == 0 ? 0 : static_cast<double>(level) / beside;
}

// A surface that goes on from the rim over the opening is a floor or a table.
Fault fault_of_opening(const Task& task, const Fitted& found) {
  constexpr double level_max = 0.3;
  const double level = level_share(task, found);
  if (level <= level_max) return std::nullopt;
  return fmt::format(
      "the best place for the rim is on something flat: inside of it, {:.0f} % of what is seen beside it is "
      "level with it",
      100 * level);
}

// Why a bin cannot be where it was fitted.
Fault fault_of(const Task& task, const Fitted& found) {
  const Agreement agreement = agreement_of(found.seen.verdicts);
  if (Fault fault = fault_of(agreement, task.known.bin)) return fault;
  if (Fault fault = fault_of_sides(agreement)) return fault;
  if (Fault fault = fault_of_image(task, found.fit, agreement)) return fault;
  return fault_of_opening(task, found);
}

// A box whose inside is not seen, such as one under a table, may fit best where a bin is not wholly as told.
const Candidate& best_seen_inside(const std::vector<Candidate>& candidates) {
  constexpr double as_good = 0.5;
  for (const Candidate& candidate : candidates) {
    if (candidate.score < as_good * candidates.front().score) break;
    if (!fault_of_inside(agreement_of(candidate.verdicts))) return candidate;
  }
  return candidates.front();
}

// At the best candidate at which a bin can be and is determined; else at the best.
Fitted best_fitted(const Task& task, const std::vector<Candidate>& candidates) {
  for (const Candidate& candidate : candidates) {
    if (!is_possible(candidate, task.known.bin)) continue;
    Fitted found = fitted_near(task, candidate);
    if (is_determined(task.known.bin, found.fit) && !fault_of(task, found)) return found;
  }
  return fitted_near(task, best_seen_inside(candidates));
}

bool are_same(const Bin& bin, const Isometry3d& first, const Isometry3d& second) {
  constexpr double apart = 0.01;  // m
  constexpr double turned = 2 * degree;
  const auto [distance, angle] = difference(bin, first, second);
  return distance < apart && angle < turned;
}

// Of what should be seen of rim and walls and is not hidden, the share that is, less what contradicts.
double share_of_structure(const Candidate& candidate) {
  int open = 0;
  int value = 0;
  for (const PixelVerdict& pixel : candidate.verdicts) {
    if (!pixel.part || kind_of_part(*pixel.part) == PartKind::floor || pixel.verdict == Verdict::hidden)
      continue;
    ++open;
    value += value_of(pixel.verdict);
  }
  return open == 0 ? 0 : static_cast<double>(value) / open;
}

// Whether a rival fits about as well as the best. Of two bins side by side, that with the most tubes shows
// least of itself.
bool fits_as_well(const Bin& bin, const Candidate& rival, const Candidate& best) {
  constexpr double as_good = 0.6;
  if (are_beside(bin, best.pose, rival.pose))
    return share_of_structure(rival) >= as_good * share_of_structure(best);
  return rival.score >= as_good * best.score && advantage(rival, best) >= as_good * advantage(best, rival);
}

Fault fault_of_determination(const Bin& bin, const BinFit& fit) {
  if (is_determined(bin, fit)) return std::nullopt;
  const double sd = corner_sd(bin, fit.covariance);
  const auto position = fit.covariance.diagonal().head<3>().cwiseSqrt().eval();
  return fmt::format(
      "what is seen of the bin does not determine its pose: a corner is known to {:.0f} mm, the middle to "
      "{:.1f}, {:.1f} and {:.1f} mm along x, y and z",
      1e3 * sd, 1e3 * position.x(), 1e3 * position.y(), 1e3 * position.z());
}

Fault fault_of_size(const char* name, double measured, double given, double margin) {
  constexpr double least = 0.005;  // m
  constexpr double share = 0.01;
  if (std::abs(measured - given) <= margin + std::max(least, share * given)) return std::nullopt;
  return fmt::format("the bin's {} is {:.3f} m in the cloud, but given as {:.3f} m", name, measured, given);
}

Fault fault_of_sizes(const Bin& given, double margin, const Bin& measured) {
  if (Fault fault = fault_of_size("length", measured.length, given.length, 2 * margin)) return fault;
  if (Fault fault = fault_of_size("width", measured.width, given.width, 2 * margin)) return fault;
  return fault_of_size("height", measured.height, given.height, margin);
}

// Something flat over a floor that is not seen is the floor itself.
Fault fault_of_floor(const std::vector<FlatPlane>& planes, const Bin& bin, const Isometry3d& pose,
                     const Agreement& agreement) {
  constexpr double share_seen = 0.1;
  constexpr double parallel = 3 * degree;
  constexpr double share_of_floor = 0.1;
  constexpr double apart = 0.01;  // m
  if (agreement.explained[0] > share_seen * agreement.expected[0]) return std::nullopt;
  for (const FlatPlane& plane : planes) {
    const double height = plane.offset - plane.normal.dot(pose.translation());
    if (plane.normal.dot(pose.linear().col(2)) < std::cos(parallel) || height < apart ||
        height > bin.height - apart || plane.area < share_of_floor * bin.length * bin.width)
      continue;
    return fmt::format(
        "the floor is {:.3f} m under the rim in the cloud, but the bin's height is given as {:.3f} m",
        bin.height - height, bin.height);
  }
  return std::nullopt;
}

// Why a fit is not the bin that was told of, for sure.
Fault fault_of_all(const Task& task, const std::vector<FlatPlane>& planes, const Fitted& found) {
  const Bin& bin = task.known.bin;
  if (Fault fault = fault_of_sizes(bin, task.known.margin, found.fit.sizes)) return fault;
  if (Fault fault = fault_of(task, found)) return fault;
  if (Fault fault = fault_of_floor(planes, bin, found.fit.pose, agreement_of(found.seen.verdicts)))
    return fault;
  return fault_of_determination(bin, found.fit);
}

// The best, then all other places for the bin where it fits about as well.
std::vector<Fitted> with_rivals(const Task& task, const std::vector<FlatPlane>& planes, Fitted best,
                                const std::vector<Candidate>& candidates) {
  const Bin& bin = task.known.bin;
  std::vector<Fitted> places{std::move(best)};
  const auto is_known = [&](const Isometry3d& pose) {
    return std::ranges::any_of(places,
                               [&](const Fitted& place) { return are_same(bin, place.seen.pose, pose); });
  };
  for (const Candidate& rival : candidates) {
    if (is_known(rival.pose) || !is_possible(rival, bin)) continue;
    if (!fits_as_well(bin, rival, places.front().seen)) continue;
    Fitted found = fitted_near(task, rival);
    if (!is_known(found.fit.pose) && !fault_of_all(task, planes, found)) places.push_back(std::move(found));
  }
  return places;
}

// The only place, or that of several bins which the guess means: it is much nearer than all others.
Fitted one_of(std::vector<Fitted> places, const Bin& bin, const Isometry3d& guess,
              const Isometry3d& to_world) {
  if (places.size() == 1) return places.front();
  const Fitted best = places.front();
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (are_beside(bin, best.fit.pose, places[i].fit.pose)) continue;
    const auto [distance, angle] = difference(bin, best.fit.pose, places[i].fit.pose);
    refuse(fmt::format("two poses fit equally well; one is {:.0f} mm and {:.0f}° from the other",
                       1e3 * distance, angle / degree));
  }
  const auto distance_of = [&](const Fitted& place) {
    return (place.fit.pose.translation() - guess.translation()).norm();
  };
  std::ranges::stable_sort(places, {}, distance_of);
  constexpr double much_nearer = 0.5;
  if (distance_of(places[0]) < bin.length && distance_of(places[0]) < much_nearer * distance_of(places[1]))
    return places.front();
  const Vector3d first = to_world * places[0].fit.pose.translation();
  const Vector3d second = to_world * places[1].fit.pose.translation();
  refuse(fmt::format("{} bins of these sizes are seen, one at [{:.3f}, {:.3f}, {:.3f}] and one at [{:.3f}, "
                     "{:.3f}, {:.3f}] m; "
                     "give the position of the one that is meant, roughly",
                     places.size(), first.x(), first.y(), first.z(), second.x(), second.y(), second.z()),
         "support.position");
}

std::vector<LocatedPart> parts_of(const BinFit& fit) {
  std::vector<LocatedPart> parts;
  LocatedPart rim{"rim", 0, 0};
  for (std::size_t part = 0; part < part_count; ++part) {
    const PartFit& found = fit.parts.at(part);
    if (found.points == 0) continue;
    switch (kind_of_part(part)) {
      case PartKind::floor:
        parts.push_back({"floor", found.points, found.noise});
        break;
      case PartKind::rim:
        rim.noise = std::max(rim.noise, found.noise);
        rim.points += found.points;
        break;
      case PartKind::inner:
        parts.push_back({name_of_wall(wall_of_part(part)), found.points, found.noise});
        break;
      case PartKind::outer:
        parts.push_back({name_of_wall(wall_of_part(part)) + ", outside", found.points, found.noise});
        break;
    }
  }
  if (rim.points > 0) parts.push_back(rim);
  return parts;
}

Located located_bin(const Support& support, const Camera& camera, const BinFit& fit,
                    const Agreement& agreement) {
  const Isometry3d guess = camera.pose.inverse(Eigen::Isometry) * support.pose;
  const Isometry3d pose = nearest_of_same(support.bin, fit.pose, guess);
  // A quarter turn swaps what belongs to x and to y.
  const Matrix3d turn = pose.linear().transpose() * fit.pose.linear();
  Matrix3d of_position = turn * fit.covariance.topLeftCorner<3, 3>() * turn.transpose();
  of_position(2, 2) += fit.floor_variance;
  Located located{
      .support = support,
      .position_sd = of_position.diagonal().cwiseSqrt(),
      .rotation_sd =
          (turn * fit.covariance.bottomRightCorner<3, 3>() * turn.transpose()).diagonal().cwiseSqrt(),
      .residual = fit.residual,
      .explained = 0,
      .contradicted = 0,
      .measured = fit.sizes,
      .is_wall_measured = fit.is_wall_measured,
      .parts = parts_of(fit)};
  located.support.pose = camera.pose * pose;
  const auto on = static_cast<double>(total(agreement.explained));
  const auto behind = static_cast<double>(total(agreement.contradicted));
  const double measured = on + behind + total(agreement.hidden);
  located.explained = on / measured;
  located.contradicted = behind / measured;
  return located;
}

// A unit or a scale of another power of ten.
void expect_scale(const SensorView& view, const Bin& bin) {
  constexpr double times = 30;
  std::vector<double> depths;
  for (const std::size_t pixel : view.sample(rays)) depths.push_back(view.points[pixel].z());
  const double depth = median(std::move(depths));
  if (depth < times * bin.length && times * depth > bin.length) return;
  refuse(
      fmt::format("the points are {:.3g} m from the camera, and the bin is {:.3g} m long: are unit and "
                  "depth_scale those of the cloud?",
                  depth, bin.length));
}

Located locate_bin(const SensorView& view, const Support& support, const Camera& camera) {
  expect_scale(view, support.bin);
  const std::vector<FlatPatch> patches = patches_of(view);
  const std::vector<FlatPlane> planes = planes_of(patches);
  if (planes.empty()) refuse("nothing flat is seen");
  constexpr double least = 0.004;  // m
  constexpr double deviations = 3;
  const Task task{view, {support.bin, support.margin, planes.front().noise}, pixels_of_image(view)};
  const std::vector<Isometry3d> poses = possible_poses(
      view, patches, planes, support.bin, std::max(least, deviations * task.known.noise) + support.margin);
  if (poses.empty()) refuse("no plane that faces the camera is seen");
  const std::vector<Candidate> candidates = candidates_of(task, poses);
  Fitted best = best_fitted(task, candidates);
  if (const Fault fault = fault_of_all(task, planes, best)) refuse(*fault);
  const Isometry3d guess = camera.pose.inverse(Eigen::Isometry) * support.pose;
  const Fitted found =
      one_of(with_rivals(task, planes, std::move(best), candidates), support.bin, guess, camera.pose);
  return located_bin(support, camera, found.fit, agreement_of(found.seen.verdicts));
}

// The lowest large plane.
FlatPlane lowest_plane(const std::vector<FlatPlane>& planes) {
  constexpr double large = 0.3;  // of the area of the largest
  const double most_oblique = std::cos(80 * degree);
  std::optional<FlatPlane> lowest;
  double largest = 0;
  for (const FlatPlane& plane : planes) {
    if (-plane.normal.z() < most_oblique) continue;
    largest = std::max(largest, plane.area);
    if (plane.area < large * largest) continue;
    if (!lowest || plane.offset < lowest->offset) lowest = plane;
  }
  if (!lowest) refuse("no plane that faces the camera is seen");
  return *lowest;
}

Isometry3d pose_on_plane(const Isometry3d& guess, const PlaneFit& fit) {
  const Vector3d normal = fit.frame.linear().col(2);
  Vector3d x = guess.linear().col(0);
  x -= normal.dot(x) * normal;
  constexpr double along_normal = 1e-3;
  if (x.norm() < along_normal) x = guess.linear().col(1) - normal.dot(guess.linear().col(1)) * normal;
  x.normalize();
  Isometry3d pose;
  pose.linear() << x, normal.cross(x), normal;
  const double height = normal.dot(guess.translation() - fit.frame.translation());
  pose.translation() = guess.translation() - height * normal;
  return pose;
}

Located located_plane(const Support& support, const Camera& camera, const PlaneFit& fit) {
  const Isometry3d pose = pose_on_plane(camera.pose.inverse(Eigen::Isometry) * support.pose, fit);
  const Isometry3d to_fit = fit.frame.inverse(Eigen::Isometry) * pose;
  const Vector3d at_origin(1, to_fit.translation().x(), to_fit.translation().y());
  // The slope along y is the rotation about x, that along x the rotation about -y.
  const Eigen::Matrix2d turn = to_fit.linear().topLeftCorner<2, 2>().transpose();
  const Eigen::Vector2d slope_sd =
      (turn * fit.covariance.bottomRightCorner<2, 2>() * turn.transpose()).diagonal().cwiseSqrt();
  Located located{.support = support,
                  .position_sd = {0, 0, std::sqrt(at_origin.dot(fit.covariance * at_origin))},
                  .rotation_sd = {slope_sd.y(), slope_sd.x(), 0},
                  .residual = fit.residual,
                  .explained = fit.explained,
                  .contradicted = fit.below,
                  .measured = support.bin,
                  .is_wall_measured = false,
                  .parts = {{"plane", fit.points, fit.noise}}};
  located.support.pose = camera.pose * pose;
  return located;
}

Located locate_plane(const SensorView& view, const Support& support, const Camera& camera) {
  const std::vector<FlatPlane> planes = planes_of(patches_of(view));
  const PlaneFit fit = fit_plane(view, lowest_plane(planes), support.margin);
  constexpr double explained_min = 0.02;
  constexpr double parallel_min = 0.45;
  constexpr double below_max = 0.2;
  if (fit.explained < explained_min)
    refuse(fmt::format("{:.1f} % of the points are on the largest plane", 100 * fit.explained));
  if (fit.parallel < parallel_min) {
    refuse(fmt::format(
        "of the surface near the best plane, only {:.0f} % is parallel to it: it cuts through the tubes; "
        "is the table in the cloud?",
        100 * fit.parallel));
  }
  if (fit.below > std::min(below_max, fit.explained)) {
    refuse(fmt::format(
        "{:.0f} % of the points are under the lowest large plane, {:.0f} % on it; crop the cloud to "
        "what lies on it",
        100 * fit.below, 100 * fit.explained));
  }
  return located_plane(support, camera, fit);
}

}  // namespace

Located locate(const PointCloud& cloud, const Support& support, const Camera& camera) {
  validate(support);
  validate(camera);
  if (support.shape == Support::Shape::nothing) {
    throw InputError({.file = "", .line = 0, .field = "support.shape"}, excerpt(name_of(support.shape)),
                     "bin or plane, to be located");
  }
  const SensorView view = view_of(cloud, camera);
  return support.shape == Support::Shape::bin ? locate_bin(view, support, camera)
                                              : locate_plane(view, support, camera);
}

}  // namespace tanglebin
