#include "tanglebin/io/toml_camera.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "tanglebin/geometry/rigid.hpp"

namespace tanglebin {
namespace {

// The orientation of a camera that looks along z, with this direction of the world up in its image.
std::optional<Eigen::Matrix3d> orientation_with_up(const Eigen::Vector3d& z, const Eigen::Vector3d& up) {
  const Eigen::Vector3d x = z.cross(up.normalized());
  constexpr double smallest = 1e-3;
  if (!(x.norm() > smallest)) return std::nullopt;
  Eigen::Matrix3d rotation;
  rotation << x.normalized(), z.cross(x.normalized()), z;
  return rotation;
}

// A view along z to a point.
Eigen::Matrix3d read_look_at(const TomlTable& table, const Eigen::Vector3d& position) {
  Eigen::Vector3d target;
  table.get("look_at", target);
  const Eigen::Vector3d z = (target - position).normalized();
  if (table.has("up")) {
    Eigen::Vector3d up;
    table.get("up", up);
    const std::optional<Eigen::Matrix3d> rotation = orientation_with_up(z, up);
    if (!rotation) table.fail("up", "no direction, or one along the view", "one across the view");
    return *rotation;
  }
  const std::optional<Eigen::Matrix3d> rotation = orientation_along(z);
  if (!rotation)
    table.fail("look_at", "a view along the world's x axis, or from a point to itself",
               "another point, or rotation_wxyz");
  return *rotation;
}

// A place on a sphere about the point that the camera looks at.
Eigen::Vector3d read_place_about(const TomlTable& table) {
  for (const std::string_view other : {"position", "rotation_wxyz", "rotation_matrix"})
    table.allow_one_of({other, "distance"});
  table.require({"look_at"});
  Eigen::Vector3d target;
  double distance = 0;
  double tilt_deg = 0;
  double azimuth_deg = 0;
  table.get("look_at", target);
  table.get("distance", distance);
  table.get("tilt_deg", tilt_deg);
  table.get("azimuth_deg", azimuth_deg);
  if (!(distance > 0)) table.fail("distance", fmt::format("{}", distance), "a positive number");
  if (!(tilt_deg >= 0 && tilt_deg <= 180))
    table.fail("tilt_deg", fmt::format("{}", tilt_deg), "an angle from 0 to 180");
  const double tilt = radians_from_degrees(tilt_deg);
  const double azimuth = radians_from_degrees(azimuth_deg);
  return target + distance * Eigen::Vector3d(std::sin(tilt) * std::cos(azimuth),
                                             std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
}

Eigen::Vector3d read_position(const TomlTable& table, const Eigen::Vector3d& preset) {
  Eigen::Vector3d position = preset;
  if (table.has("tilt_deg") || table.has("azimuth_deg")) table.require({"distance"});
  if (table.has("distance")) return read_place_about(table);
  table.get("position", position);
  return position;
}

}  // namespace

Keys camera_intrinsics_keys() {
  return all({{"hfov_deg", "focal_length_px"}, keys(camera_size_fields), keys(camera_lens_fields)});
}

Keys camera_pose_keys() {
  return {"position", "rotation_wxyz", "rotation_matrix", "look_at", "distance", "tilt_deg", "azimuth_deg"};
}

void read_camera_intrinsics(const TomlTable& table, const Camera& preset, Camera& camera) {
  table.allow_one_of({"hfov_deg", "focal_length_px", "fx"});
  table.allow_one_of({"hfov_deg", "focal_length_px", "fy"});
  if (table.has("fx")) table.require({"fy"});
  if (table.has("fy")) table.require({"fx"});

  read_fields(table, camera_size_fields, camera);
  double focal_length = preset.fx * (static_cast<double>(camera.width) / preset.width);
  table.get("focal_length_px", focal_length);
  if (table.has("focal_length_px") && !(focal_length > 0))
    table.fail("focal_length_px", fmt::format("{}", focal_length), "a positive number of pixels");
  if (table.has("hfov_deg")) {
    double degrees = 0;
    table.get("hfov_deg", degrees);
    if (!(degrees > 0 && degrees < 180))
      table.fail("hfov_deg", fmt::format("{}", degrees), "an angle between 0 and 180");
    focal_length = focal_length_from_hfov(camera.width, radians_from_degrees(degrees));
  }
  camera.fx = camera.fy = focal_length;
  camera.cx = (camera.width - 1.0) / 2;
  camera.cy = (camera.height - 1.0) / 2;
  read_fields(table, camera_lens_fields, camera);
}

void read_camera_pose(const TomlTable& table, Camera& camera) {
  table.allow_one_of({"rotation_wxyz", "rotation_matrix", "look_at"});
  if (table.has("up")) table.require({"look_at"});
  for (const std::string_view other : camera_pose_keys()) table.allow_one_of({other, "camera_to_world"});
  const Eigen::Vector3d position = read_position(table, camera.pose.translation());
  Eigen::Matrix3d rotation = camera.pose.linear();
  read_rotation(table, rotation);
  if (table.has("look_at")) rotation = read_look_at(table, position);
  camera.pose.translation() = position;
  camera.pose.linear() = rotation;
  read_rigid_motion(table, "camera_to_world", camera.pose);
}

std::optional<Eigen::Matrix3d> orientation_along(const Eigen::Vector3d& z) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX() - z.x() * z;
  constexpr double smallest = 1e-3;
  if (!(x.norm() > smallest) || z.isZero()) return std::nullopt;
  Eigen::Matrix3d rotation;
  rotation << x.normalized(), z.cross(x.normalized()), z;
  return rotation;
}

void read_rigid_motion(const TomlTable& table, std::string_view key, Eigen::Isometry3d& pose) {
  if (!table.has(key)) return;
  Eigen::Matrix4d rows;
  table.get(key, rows);
  const std::optional<Eigen::Isometry3d> motion = rigid_motion_near(rows);
  if (!motion)
    table.fail(key, "a matrix that is no rigid motion",
               "a rotation and, in the last column, a position; the last row is 0, 0, 0, 1");
  pose = *motion;
}

void read_rotation(const TomlTable& table, Eigen::Matrix3d& rotation) {
  table.get("rotation_matrix", rotation);
  if (!table.has("rotation_wxyz")) return;
  Eigen::Vector4d wxyz;
  table.get("rotation_wxyz", wxyz);
  if (!(std::abs(wxyz.norm() - 1) <= 0.01))
    table.fail("rotation_wxyz", fmt::format("a quaternion of norm {:.6g}", wxyz.norm()), "a unit quaternion");
  rotation = Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized().toRotationMatrix();
}

}  // namespace tanglebin
