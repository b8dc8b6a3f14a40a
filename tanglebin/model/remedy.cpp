#include "tanglebin/model/remedy.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include "tanglebin/base/median.hpp"
#include "tanglebin/cloud/depth_scales.hpp"

namespace tanglebin {
namespace {

using Eigen::Affine3d;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// How the points and the camera would be without a mistake.
struct Guess {
  Affine3d cloud;     ///< moves the points, in the world frame
  Isometry3d camera;  ///< the camera's pose
  int mistakes;       ///< how many there are
  Remedy remedy;
};

/// Tells how well points fit a scene.
class Fit {
public:
  Fit(const std::vector<Vector3d>& points, const KnownScene& known)
      : points_(points),
        known_(known),
        parts_(solid_parts(known.support)),
        around_(space_of(known.support)),
        spread_(spread_of(points)),
        least_spread_(least_spread_of(known)) {}

  // The share of the points that the camera can see in the space of the tubes, and the share on the support.
  // Points that are nearly in one place show no tube, and a camera sees nothing from under a floor.
  double of(const Affine3d& motion, const Isometry3d& pose) const {
    // No motion here changes proportions.
    if (std::cbrt(std::abs(motion.linear().determinant())) * spread_ < least_spread_) return 0;
    Camera camera = known_.camera;
    camera.pose = pose;
    const Isometry3d to_support = known_.support.pose.inverse(Eigen::Isometry);
    const bool has_support = known_.support.shape != Support::Shape::nothing;
    if (has_support && (to_support * pose.translation()).z() <= 0) return 0;
    double fits = 0;
    for (const Vector3d& point : points_) {
      const Vector3d moved = motion * point;
      const Vector3d in_support = to_support * moved;
      if (!is_seen(camera, moved) || !around_.contains(in_support)) continue;
      fits += is_on_support(in_support) ? 2 : 1;
    }
    return fits / static_cast<double>(points_.size());
  }

private:
  static constexpr double near = 0.005;  // m
  static constexpr double far = 20;      // m

  // m: what is seen of tubes is no smaller than one is thick, and in a bin no mere spot.
  static double least_spread_of(const KnownScene& known) {
    constexpr double spot = 0.05;  // of the bin's length
    const double thickness = 2 * std::ranges::min(known.kinds, {}, &TubeKind::radius).radius;
    return known.support.shape == Support::Shape::bin ? std::max(thickness, spot * known.support.bin.length)
                                                      : thickness;
  }

  // m, median distance from the point in the middle: some points may be where nothing was measured.
  static double spread_of(const std::vector<Vector3d>& points) {
    const auto middle_along = [&](Eigen::Index axis) {
      std::vector<double> places;
      places.reserve(points.size());
      for (const Vector3d& point : points) places.push_back(point[axis]);
      return median(std::move(places));
    };
    const Vector3d middle(middle_along(0), middle_along(1), middle_along(2));
    std::vector<double> distances;
    distances.reserve(points.size());
    for (const Vector3d& point : points) distances.push_back((point - middle).norm());
    return median(std::move(distances));
  }

  static Eigen::AlignedBox3d space_of(const Support& support) {
    if (support.shape == Support::Shape::nothing)
      return {Vector3d::Constant(-2 * far), Vector3d::Constant(2 * far)};
    if (support.shape == Support::Shape::plane) return {Vector3d(-far, -far, -near), Vector3d(far, far, far)};
    constexpr double above = 0.25;
    const Bin& bin = support.bin;
    const Vector3d half(bin.length / 2 + bin.wall + near, bin.width / 2 + bin.wall + near, 0);
    return {-half - near * Vector3d::UnitZ(), half + (bin.height + above) * Vector3d::UnitZ()};
  }

  static bool is_seen(const Camera& camera, const Vector3d& point) {
    constexpr double nearest = 0.05;
    const double depth = depth_of(camera, point);
    return depth > nearest && depth < far && pixel_of(camera, point);
  }

  // On a surface that can be seen: not deep in the solid.
  bool is_on_support(const Vector3d& point) const {
    return point.z() > -near && std::ranges::any_of(parts_, [&](const Eigen::AlignedBox3d& part) {
             const double depth = std::min((point - part.min()).minCoeff(), (part.max() - point).minCoeff());
             return std::abs(depth) < near;
           });
  }

  const std::vector<Vector3d>& points_;
  const KnownScene& known_;
  std::vector<Eigen::AlignedBox3d> parts_;
  Eigen::AlignedBox3d around_;
  double spread_;        // m
  double least_spread_;  // m
};

/// The frames in which a cloud may be.
struct Frame {
  const char* name;
  const char* option;
  const char* axes;  // a clause
  Isometry3d pose;   // frame → world frame
};

std::string with_sign(double sign, std::string_view axis) {
  return fmt::format("{}{}", sign < 0 ? "−" : "", axis);
}

// "(x, −y, −z)"
std::string text_of(const Matrix3d& axes) {
  constexpr std::array names = {"x", "y", "z"};
  std::string text;
  for (Eigen::Index row = 0; row < 3; ++row) {
    Eigen::Index column = 0;
    axes.row(row).cwiseAbs().maxCoeff(&column);
    text += (row == 0 ? "" : ", ") + with_sign(axes(row, column), names.at(static_cast<std::size_t>(column)));
  }
  return "(" + text + ")";
}

// All ways to take the axes of another frame for those of this one: those that keep x first, mirrored ones
// last.
std::vector<Matrix3d> exchanged_axes() {
  std::vector<Matrix3d> all;
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (unsigned signs = 0; signs < 8; ++signs) {
      Matrix3d axes = Matrix3d::Zero();
      for (unsigned row = 0; row < 3; ++row) axes(row, order.at(row)) = (signs >> row & 1U) == 0 ? 1 : -1;
      all.push_back(axes);
    }
  } while (std::ranges::next_permutation(order).found);
  // Not std::ranges, whose subranges clang 14 does not compile.
  std::stable_partition(all.begin(), all.end(), [](const Matrix3d& axes) { return axes(0, 0) > 0; });
  std::stable_partition(all.begin(), all.end(), [](const Matrix3d& axes) { return axes.determinant() > 0; });
  return all;
}

// What to say about a cloud that was taken to be in the frame `told`.
Remedy remedy_of(const Frame& told, const Frame& right, double unit, const Matrix3d& axes) {
  std::string code;
  std::string advice;
  const auto add = [&](const char* what, const std::string& text) {
    if (code.empty()) code = what;
    advice += (advice.empty() ? "" : " and ") + text;
  };
  if (&told != &right) add("frame", fmt::format("in {} ({})", right.name, right.option));
  if (unit == 0.01) add("unit", "in centimetres (write them in metres or millimetres)");
  if (unit == 0.001) add("unit", "in millimetres (--unit mm)");
  if (unit > 1) add("unit", "in metres (--unit m)");
  if (axes.isIdentity()) return {code, "would fit " + advice};
  return {code.empty() ? "axes" : code,
          fmt::format("would fit {}{}if each point (x, y, z) were {}: in {}, {}", advice,
                      advice.empty() ? "" : " ", text_of(axes), right.name, right.axes)};
}

// How many mistakes an exchange of axes is: a mirrored frame is the least likely.
int mistakes_of(const Matrix3d& axes) {
  if (axes.isIdentity()) return 0;
  return axes.determinant() > 0 ? 2 : 3;
}

// The cloud in another frame or unit, or with other axes.
std::vector<Guess> guesses_of_frame(const KnownScene& known) {
  const Isometry3d& camera = known.camera.pose;
  const std::array frames = {
      Frame{"the camera's frame", "--frame camera", "x points right, y down and z along the view", camera},
      Frame{"the world frame", "--frame world", "z points up", Isometry3d::Identity()}};
  std::vector<Guess> all;
  for (const Frame& told : frames) {
    for (const Frame& right : frames) {
      for (const double unit : {1.0, 0.001, 1000.0, 0.01}) {
        for (const Matrix3d& axes : exchanged_axes()) {
          const int mistakes = (&told != &right ? 1 : 0) + (unit != 1 ? 1 : 0) + mistakes_of(axes);
          if (mistakes == 0) continue;
          const Affine3d motion =
              right.pose * Affine3d(Eigen::Scaling(unit) * axes) * told.pose.inverse(Eigen::Isometry);
          all.push_back({motion, camera, mistakes, remedy_of(told, right, unit, axes)});
        }
      }
    }
  }
  return all;
}

// The depths are from the camera, so a depth image is in no other frame.
std::vector<Guess> guesses_of_depth_scale(const KnownScene& known, double told) {
  const Isometry3d& camera = known.camera.pose;
  std::vector<Guess> all;
  for (const double scale : other_depth_scales(told)) {
    const Affine3d motion = camera * Affine3d(Eigen::Scaling(told / scale)) * camera.inverse(Eigen::Isometry);
    all.push_back(
        {motion, camera, 1, {"unit", fmt::format("would fit with depth_scale = {:.6g} in [camera]", scale)}});
  }
  return all;
}

// Another pose of the camera or the support.
std::vector<Guess> guesses_of_pose(const KnownScene& known) {
  const Isometry3d& camera = known.camera.pose;
  const Isometry3d turned(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX()));
  std::vector<Guess> all;
  const auto other_camera = [&](const Isometry3d& pose, const std::string& advice) {
    all.push_back({Affine3d::Identity(), pose, 1, {"pose", advice}});
    all.push_back({Affine3d(pose * camera.inverse(Eigen::Isometry)), pose, 1, {"pose", advice}});
  };
  other_camera(camera.inverse(Eigen::Isometry),
               "would fit the inverse of the camera's pose: camera_to_world seems to be world_to_camera");
  other_camera(camera * turned,
               "would fit if the camera's pose were that of a frame with x right, y up, z against the view: "
               "turn it by 180° about x");
  const Isometry3d upside_down = known.support.pose * turned * known.support.pose.inverse(Eigen::Isometry);
  all.push_back(
      {Affine3d(upside_down),
       upside_down * camera,
       1,
       {"support", "would fit if the support's pose were turned by 180° about x: its z axis points up"}});
  return all;
}

}  // namespace

std::optional<Remedy> remedy_for(const std::vector<Vector3d>& points, const KnownScene& known,
                                 std::optional<double> depth_scale) {
  if (points.empty()) return std::nullopt;
  const Fit fit(points, known);
  std::vector<Guess> all =
      depth_scale ? guesses_of_depth_scale(known, *depth_scale) : guesses_of_frame(known);
  std::ranges::move(guesses_of_pose(known), std::back_inserter(all));
  std::vector<double> fits;
  fits.reserve(all.size());
  for (const Guess& guess : all) fits.push_back(fit.of(guess.cloud, guess.camera));
  const double best = std::ranges::max(fits);
  constexpr double gain = 0.3;
  constexpr double least = 0.8;
  if (best < std::max(least, fit.of(Affine3d::Identity(), known.camera.pose) + gain)) return std::nullopt;
  const Guess* simplest = nullptr;
  double its_fit = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    constexpr double nearly = 0.95;
    constexpr double clearly = 0.05;
    if (fits[i] < nearly * best) continue;
    const bool is_simpler = simplest == nullptr || all[i].mistakes < simplest->mistakes ||
                            (all[i].mistakes == simplest->mistakes && fits[i] > its_fit + clearly);
    if (!is_simpler) continue;
    simplest = &all[i];
    its_fit = fits[i];
  }
  return simplest == nullptr ? std::nullopt : std::optional(simplest->remedy);
}

}  // namespace tanglebin
