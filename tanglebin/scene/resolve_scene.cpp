#include "tanglebin/scene/resolve_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "tanglebin/base/error.hpp"
#include "tanglebin/base/millimetres.hpp"
#include "tanglebin/model/axis/radius.hpp"
#include "tanglebin/scene/image_of_cloud.hpp"

namespace tanglebin {
namespace {

using Eigen::Isometry3d;
using Notes = std::vector<std::string>;

constexpr double millimetre = 0.001;  // m

std::string percent(double share) {
  return fmt::format("{:.0f} %", 100 * share);
}

// Scenes are from some centimetres to some metres wide.
double unit_of(const Scene& scene, const PointCloud& cloud, Notes& notes) {
  if (scene.camera.unit) return *scene.camera.unit;
  constexpr double smallest = 0.02;
  constexpr double largest = 10;
  const std::optional<double> size = extent(cloud);
  if (!size || (*size >= smallest && *size <= largest)) return 1;
  if (*size >= 5 * largest && *size <= largest / millimetre) {
    notes.push_back(fmt::format("the cloud is {:.4g} wide; its numbers are taken for millimetres", *size));
    return millimetre;
  }
  throw InputError({"", 0, "unit"}, fmt::format("points within {:.4g} of each other", *size),
                   fmt::format("a scene of {} to {} m; say what the numbers are: --unit m or --unit mm, or "
                               "unit in the scene file's [camera]",
                               smallest, largest));
}

PointCloud positions_of(const PointCloud& cloud) {
  PointCloud positions;
  positions.points = cloud.points;
  positions.width = cloud.width;
  positions.height = cloud.height;
  positions.viewpoint = cloud.viewpoint;
  positions.depth_scale = cloud.depth_scale;
  return positions;
}

// To metres.
void scale(PointCloud& cloud, double unit) {
  if (unit == 1) return;
  for (Eigen::Vector3f& point : cloud.points) point = (unit * point.cast<double>()).cast<float>();
  if (cloud.viewpoint) cloud.viewpoint->translation() *= unit;
}

// Many programs write (0, 0, 0), where the sensor is, for a pixel without a measurement. One camera sees no
// point twice, so several are none.
void forget_zeros(PointCloud& cloud, Notes& notes) {
  const auto is_zero = [](const Eigen::Vector3f& point) { return point == Eigen::Vector3f::Zero(); };
  const auto zeros = std::ranges::count_if(cloud.points, is_zero);
  if (zeros < 2) return;
  std::ranges::replace_if(cloud.points, is_zero,
                          Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  notes.push_back(fmt::format("{} points at exactly (0, 0, 0) are taken for not measured", zeros));
}

/// A frame that the cloud may be in, and how well it shows an image there.
struct Candidate {
  CloudFrame frame;
  std::optional<FittedIntrinsics> fitted;  ///< if the camera's intrinsics are not known
  double share;  ///< of the points that are in the image; with fitted intrinsics, 1 if they fit, else 0
};

// Turns points by half a turn about x: between OpenGL's camera frame, whose z points backwards and y up, and
// this one.
Isometry3d turned_about_x() {
  return Isometry3d(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()));
}

/// Of a cloud in metres.
class CameraSearch {
public:
  CameraSearch(const SceneCamera& camera, const PointCloud& cloud) : camera_(camera), cloud_(cloud) {}

  /// The camera, and the frame in which the cloud's points are.
  std::pair<Camera, CloudFrame> find(Notes& notes) const {
    expect_image();
    const std::optional<Isometry3d> pose = known_pose(notes);
    const Candidate chosen = choose(pose, notes);
    const Isometry3d known = pose.value_or(Isometry3d::Identity());
    return {camera_with(intrinsics_in(chosen, known, notes), known), chosen.frame};
  }

private:
  static constexpr double nearly_all = 0.9;

  std::optional<Intrinsics> known_intrinsics() const {
    std::optional<Intrinsics> known = camera_.intrinsics;
    if (known && known->width == 0) {
      known->width = static_cast<int>(cloud_.width);
      known->height = static_cast<int>(cloud_.height);
    }
    return known;
  }

  void expect_image() const {
    if (is_organized(cloud_)) return;
    if (!camera_.intrinsics)
      throw InputError(
          {"", 0, "camera"}, "neither the camera's intrinsics nor an organized cloud, which shows them",
          "--camera FILE (of ROS, Open3D, BOP or `tanglebin scan --depth`), or a scene file with "
          "[camera]. For a cloud that is no camera's image (of a line scanner, merged from several views), "
          "describe a camera far above it (docs/real-scans.md)");
    if (camera_.intrinsics->width == 0)
      throw InputError(
          {"", 0, "camera"}, "a camera without the size of its image, and a cloud that is not organized",
          "the depth image, an organized cloud, or a scene file with width and height in [camera]");
  }

  std::optional<Isometry3d> known_pose(Notes& notes) const {
    if (camera_.pose) return camera_.pose;
    if (cloud_.viewpoint) {
      notes.emplace_back("the camera's pose is the cloud's VIEWPOINT");
      return cloud_.viewpoint;
    }
    if (camera_.frame == CloudFrame::world)
      throw InputError({"", 0, "camera"},
                       "points in the world frame, and nothing that says where the camera is",
                       "camera_to_world, or position and look_at, in the scene file's [camera]; or --frame "
                       "camera, if the points are as the camera gave them");
    return std::nullopt;
  }

  // From the frame of the points into the camera's.
  static Isometry3d motion_from(CloudFrame frame, const Isometry3d& pose) {
    return frame == CloudFrame::camera ? Isometry3d::Identity() : pose.inverse();
  }

  Candidate candidate(CloudFrame frame, const Isometry3d& pose) const {
    return candidate_with(frame, motion_from(frame, pose));
  }

  Candidate candidate_with(CloudFrame frame, const Isometry3d& motion) const {
    if (const std::optional<Intrinsics> known = known_intrinsics())
      return {frame, {}, share_in_image(cloud_, Eigen::Affine3d(motion.matrix()), *known)};
    const std::optional<FittedIntrinsics> fitted = fit_intrinsics(cloud_, motion);
    return {frame, fitted, fitted && fits(*fitted) ? 1.0 : 0.0};
  }

  Candidate choose(const std::optional<Isometry3d>& pose, Notes& notes) const {
    if (camera_.frame) return candidate(*camera_.frame, pose.value_or(Isometry3d::Identity()));
    const Candidate in_camera = candidate(CloudFrame::camera, Isometry3d::Identity());
    if (!pose || !extent(cloud_)) return choose_without_pose(in_camera, notes);
    const Candidate in_world = candidate(CloudFrame::world, *pose);
    if (pose->isApprox(Isometry3d::Identity())) return in_world;
    return choose(in_camera, in_world, *pose, notes);
  }

  Candidate choose_without_pose(const Candidate& in_camera, Notes& notes) const {
    constexpr double half = 0.5;
    if (extent(cloud_) && in_camera.share < half) {
      expect_forwards(CloudFrame::camera, Isometry3d::Identity());
      throw InputError(
          {"", 0, "camera"},
          fmt::format("in the camera's frame, {}; if the cloud is in another, give the camera's pose: "
                      "camera_to_world, or position and look_at, in the scene file's [camera]",
                      describe(in_camera)));
    }
    notes.emplace_back("the camera's pose is not known: the world frame is the camera's");
    return in_camera;
  }

  Candidate choose(const Candidate& in_camera, const Candidate& in_world, const Isometry3d& pose,
                   Notes& notes) const {
    constexpr double half = 0.5;
    for (const auto& [likely, other] : {std::pair{in_camera, in_world}, {in_world, in_camera}}) {
      if (likely.share < nearly_all || other.share > half) continue;
      notes.push_back(fmt::format("the cloud is taken to be in the {} frame: there, {}",
                                  likely.frame == CloudFrame::camera ? "camera's" : "world",
                                  describe(likely)));
      return likely;
    }
    for (const Candidate& either : {in_camera, in_world}) expect_forwards(either.frame, pose);
    throw InputError(
        {"", 0, "frame"},
        fmt::format("in the camera's frame, {}, and in the world frame, {}; say in which the cloud is: "
                    "--frame camera or --frame world, or frame in the scene file's [camera]",
                    describe(in_camera), describe(in_world)));
  }

  bool are_behind(const Isometry3d& motion) const { return share_behind(cloud_, motion) > nearly_all; }

  // Throws if the camera would see the cloud if y and z pointed the other way, as in OpenGL's camera frame.
  void expect_forwards(CloudFrame frame, const Isometry3d& pose) const {
    const Isometry3d motion = motion_from(frame, pose);
    if (!are_behind(motion) || candidate_with(frame, turned_about_x() * motion).share < nearly_all) return;
    const bool is_camera = frame == CloudFrame::camera;
    throw InputError(
        {"", 0, "axes"},
        fmt::format("nearly all points behind the camera, if the cloud is in the {} frame",
                    is_camera ? "camera's" : "world"),
        fmt::format("x to the right, y down and z along the view; with y up and z backwards, as in OpenGL, "
                    "they would fit: {}",
                    is_camera ? "write (x, −y, −z) for each point (x, y, z), or give frame = \"world\" and "
                                "OpenGL's camera_to_world (docs/real-scans.md)"
                              : "turn the camera's pose by 180° about its x axis"));
  }

  std::string describe(const Candidate& candidate) const {
    if (camera_.intrinsics)
      return fmt::format("{} of the points are in the camera's image", percent(candidate.share));
    if (!candidate.fitted)
      return candidate.frame == CloudFrame::camera && are_behind(Isometry3d::Identity())
                 ? "nearly all points are behind the camera (does z point backwards, as in OpenGL?)"
                 : "too few points are in front of the camera";
    if (is_image(*candidate.fitted) && !fits(*candidate.fitted))
      return "the image is upside down or mirrored: x should point right and y down";
    return fmt::format("the points are {:.2g} pixels from a pinhole camera's", candidate.fitted->residual);
  }

  // An organized cloud shows whether a camera file is another's. One that is a part of the image has its
  // focal length, one that is reduced its field of view.
  void expect_same_camera(const Intrinsics& known, const Isometry3d& motion) const {
    if (!is_organized(cloud_)) return;
    const std::optional<FittedIntrinsics> fitted = fit_intrinsics(cloud_, motion);
    if (!fitted || !fits(*fitted)) return;
    const Intrinsics& seen = fitted->intrinsics;
    const auto is_near = [&](double focal_length) {
      constexpr double tolerance = 0.05;
      return std::abs(focal_length - known.fx) <= tolerance * known.fx;
    };
    if (is_near(seen.fx) || is_near(seen.fx * known.width / seen.width)) return;
    throw InputError(
        {"", 0, "camera"}, fmt::format("a focal length of {:.4g} pixels, fx", known.fx),
        fmt::format("about {:.4g}, which the organized cloud shows; is the camera another's?", seen.fx));
  }

  Intrinsics intrinsics_in(const Candidate& chosen, const Isometry3d& pose, Notes& notes) const {
    if (const std::optional<Intrinsics> known = known_intrinsics()) {
      expect_same_camera(*known, motion_from(chosen.frame, pose));
      return *known;
    }
    if (!chosen.fitted || !fits(*chosen.fitted)) {
      expect_forwards(chosen.frame, pose);
      throw InputError(
          {"", 0, "camera"},
          fmt::format("the organized cloud does not show its camera: if its rows and columns are an "
                      "image's, {}; give --camera FILE",
                      describe(chosen)));
    }
    const auto& [intrinsics, residual] = *chosen.fitted;
    notes.push_back(
        fmt::format("the intrinsics are fitted to the organized cloud, to {:.2g} pixels: fx {:.6g}, fy "
                    "{:.6g}, cx {:.6g}, cy {:.6g}",
                    residual, intrinsics.fx, intrinsics.fy, intrinsics.cx, intrinsics.cy));
    return intrinsics;
  }

  const SceneCamera& camera_;
  const PointCloud& cloud_;
};

void move(PointCloud& cloud, const Isometry3d& motion) {
  for (Eigen::Vector3f& point : cloud.points) point = (motion * point.cast<double>()).cast<float>();
}

RadiusEstimate radius_from(const PointCloud& cloud, const KnownScene& known,
                           const std::optional<LengthRange>& range, const std::function<void()>& at_place) {
  if (!range) return estimate_radius(cloud, known, {}, at_place);
  RadiusEstimate found = estimate_radius(cloud, known, {range->min, range->max}, at_place);
  constexpr double deviations = 3;
  const double error = deviations * found.standard_error;
  if (found.radius < range->min - error || found.radius > range->max + error)
    throw InputError({"", 0, "radius"},
                     fmt::format("tubes of a radius of {:.5f} m, which the cloud shows", found.radius),
                     fmt::format("the radius to be {} to {} m, as it is given", range->min, range->max));
  found.radius = std::clamp(found.radius, range->min, range->max);
  return found;
}

void find_kinds(const Scene& scene, const std::function<void()>& at_place, ResolvedScene& resolved) {
  const std::vector<TubeClass> classes = scene.tubes.empty() ? std::vector<TubeClass>(1) : scene.tubes;
  resolved.known.kinds.clear();
  for (const TubeClass& tubes : classes) {
    TubeKind kind = kind_of(tubes);
    if (kind.radius == 0) {
      if (classes.size() > 1)
        throw InputError({"", 0, fmt::format("tube[{}].radius", resolved.known.kinds.size())},
                         fmt::format("{} classes of tubes, one without a radius", classes.size()),
                         "a number for each; only the radius of a single class can be estimated");
      const RadiusEstimate found = radius_from(resolved.cloud, resolved.known, tubes.radius, at_place);
      kind.radius = found.radius;
      resolved.notes.push_back(
          fmt::format("the radius is estimated: {:.5f} m, ± {:.5f} m and the error of the sensor's scale",
                      found.radius, found.standard_error));
    }
    resolved.known.kinds.push_back(kind);
  }
  if (scene.tubes.empty()) resolved.notes.emplace_back("the tubes' length is not known");
}

// A bin's size limits the length in validate(KnownScene). A coiled cable may be many times as long as all
// that is seen, but not a hundred times.
void expect_length_of_size(const TubeKind& kind, double size, std::size_t index) {
  constexpr double too_many_times = 100;
  if (!kind.length_is_known() || kind.length() <= too_many_times * size) return;
  throw InputError(
      {"", 0, fmt::format("tube[{}].{}", index, field_of_length(kind))}, fmt::format("{} m", kind.length()),
      fmt::format("at most {:.3g} m, a hundred times the size of the cloud{}", too_many_times * size,
                  hint_of_millimetres(kind.length(), too_many_times * size)));
}

void expect_lengths_of_size(const ResolvedScene& resolved) {
  if (resolved.known.support.shape == Support::Shape::bin) return;
  const std::optional<double> size = extent(resolved.cloud);
  if (!size) return;
  const std::vector<TubeKind>& kinds = resolved.known.kinds;
  for (std::size_t i = 0; i < kinds.size(); ++i) expect_length_of_size(kinds[i], *size, i);
}

}  // namespace

ResolvedScene resolve_without_tubes(const Scene& scene, const PointCloud& cloud) {
  validate(scene);
  ResolvedScene resolved;
  resolved.cloud = positions_of(cloud);
  forget_zeros(resolved.cloud, resolved.notes);
  scale(resolved.cloud, unit_of(scene, resolved.cloud, resolved.notes));
  const auto [camera, frame] = CameraSearch(scene.camera, resolved.cloud).find(resolved.notes);
  resolved.known.camera = camera;
  if (frame == CloudFrame::camera && resolved.known.camera.pose.matrix() != Eigen::Matrix4d::Identity())
    move(resolved.cloud, resolved.known.camera.pose);
  resolved.known.support = scene.support.value_or(Support{.shape = Support::Shape::nothing});
  if (!scene.support)
    resolved.notes.emplace_back(
        "nothing is known of a bin or a floor; a scene file's [support] says what there is");
  return resolved;
}

ResolvedScene resolve(const Scene& scene, const PointCloud& cloud, const std::function<void()>& at_place) {
  ResolvedScene resolved = resolve_without_tubes(scene, cloud);
  find_kinds(scene, at_place, resolved);
  validate(resolved.known);
  expect_lengths_of_size(resolved);
  return resolved;
}

}  // namespace tanglebin
