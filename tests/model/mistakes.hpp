#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "tanglebin/model/model_tubes.hpp"
#include "tests/model/scene/scanned.hpp"

// A scan, and what people get wrong about one.
namespace tanglebin::test {

/// A heap, as a tilted camera sees it, and what is known of it.
struct View {
  PointCloud cloud;
  KnownScene scene;
};

inline std::vector<Tube> heap() {
  const double r = radius;
  return {chain(1, r, {{-0.2, -0.05, r}, {-0.05, 0, r}, {0.1, 0, r}, {0.25, 0.06, r}}),
          chain(2, r, {{0.02, -0.1, r}, {0.02, 0, 0.06}, {0.03, 0.16, r}}),
          chain(3, r, {{-0.25, 0.12, r}, {-0.12, 0.15, r}, {-0.05, 0.1, r}, {0.15, 0.12, r}}),
          chain(4, r, {{-0.2, -0.15, r}, {0.2, -0.12, r}})};
}

inline View scanned_view() {
  View view;
  view.scene.support.bin = bin_preset("paper");
  view.scene.camera = camera_at({0.3, 0.2, 1.6}, {0, 0, 0}, 800, 600, 0.7);
  const Scan scan_of_heap = scan(heap(), view.scene.support.bin, view.scene.camera);
  view.cloud = cloud_from_scan(scan_of_heap, CloudOf::tubes_and_bin, 4);
  view.scene.kinds[0].segments = {{1, 2, 0.48}};
  view.scene.kinds[0].length_min = 0.36;
  return view;
}

inline const View& right_view() {
  static const View view = scanned_view();
  return view;
}

inline PointCloud organized() {
  const View& view = right_view();
  return organized_cloud_from_scan(scan(heap(), view.scene.support.bin, view.scene.camera),
                                   CloudOf::tubes_and_bin, 4);
}

inline void move(PointCloud& cloud, const Eigen::Affine3d& motion) {
  for (Eigen::Vector3f& point : cloud.points) point = (motion * point.cast<double>()).cast<float>();
}

/// A mistake, and what is said of it.
struct Mistake {
  std::string name;
  std::function<void(View&)> make;
  std::string code;
  Finding::Severity severity;
  std::string words;  ///< a part of the message
};

inline std::vector<Mistake> mistakes() {
  constexpr auto error = Finding::Severity::error;
  constexpr auto warning = Finding::Severity::warning;
  static constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const auto to_camera = [](View& view) {
    move(view.cloud, Eigen::Affine3d(view.scene.camera.pose.inverse()));
  };
  const auto scale = [](double factor) {
    return [factor](View& view) { move(view.cloud, Eigen::Affine3d(Eigen::Scaling(factor))); };
  };
  const auto axes = [](const Vector3d& x, const Vector3d& y, const Vector3d& z) {
    return [=](View& view) {
      Eigen::Matrix3d rows;
      rows << x.transpose(), y.transpose(), z.transpose();
      move(view.cloud, Eigen::Affine3d(rows));
    };
  };
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  return {
      {"camera's frame", to_camera, "frame", error, "in the camera's frame (--frame camera)"},
      {"told to be in the camera's frame",
       [](View& view) { move(view.cloud, Eigen::Affine3d(view.scene.camera.pose)); }, "frame", error,
       "in the world frame (--frame world)"},
      {"millimetres", scale(1000), "unit", error, "in millimetres (--unit mm)"},
      {"centimetres", scale(100), "unit", error, "in centimetres"},
      {"told to be in millimetres", scale(0.001), "unit", error, "in metres (--unit m)"},
      {"camera's frame and millimetres",
       [=](View& view) {
         to_camera(view);
         scale(1000)(view);
       },
       "frame", error, "in millimetres (--unit mm)"},
      {"z down", axes(x, -y, -z), "axes", error, "(x, −y, −z)"},
      {"y up", axes(x, z, -y), "axes", error, "(x, −z, y)"},
      {"x and y swapped, as in a mirror", axes(y, x, z), "axes", error, "if each point (x, y, z) were ("},
      {"OpenGL's camera frame",
       [=](View& view) {
         to_camera(view);
         axes(x, -y, -z)(view);
       },
       "frame", error,
       "they would fit in the camera's frame (--frame camera) if each point (x, y, z) were (x, −y, −z): in "
       "the camera's frame, x points right, y down and z along the view"},
      {"pose inverted", [](View& view) { view.scene.camera.pose = view.scene.camera.pose.inverse(); }, "pose",
       error, "the inverse of the camera's pose"},
      {"the camera's position in millimetres",
       [](View& view) { view.scene.camera.pose.translation() *= 1000; }, "camera", warning,
       "the camera's pose in another unit"},
      {"support upside down",
       [](View& view) {
         view.scene.support.pose = Eigen::Isometry3d(Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX()));
       },
       "support", error, "turned by 180°"},
      {"another bin", [](View& view) { view.scene.support.bin = bin_preset("published"); }, "bin", warning,
       "of the bin's rim"},
      {"a smaller bin",
       [](View& view) {
         view.scene.support.bin.length = 0.4;
         view.scene.support.bin.width = 0.3;
       },
       "bin", warning, "bin"},
      {"the bin 20 mm beside its place", [](View& view) { view.scene.support.pose.translation().x() = 0.02; },
       "bin", warning, "the bin's rim is seen about 20 mm further in -x"},
      {"the bin 7 mm beside its place",
       [](View& view) { view.scene.support.pose.translation().y() = -0.007; }, "bin", warning,
       "the bin's rim is seen about 7 mm further in +y"},
      {"the bin 10 mm too low", [](View& view) { view.scene.support.pose.translation().z() = -0.01; },
       "floor", warning, "the floor is 10.0 mm above"},
      {"twice the radius: the diameter", [](View& view) { view.scene.kinds[0].radius *= 2; }, "radius",
       warning, "they look like tubes of radius 12.5 mm"},
      {"half the radius", [](View& view) { view.scene.kinds[0].radius /= 2; }, "radius", error,
       "they look like tubes of radius 12.5 mm: --radius 0.0125"},
      {"half the length",
       [](View& view) {
         view.scene.kinds[0].segments = {{1, 2, 0.25}};
         view.scene.kinds[0].length_min = 0.2;
       },
       "length", warning, "longer than known"},
      {"twice the length",
       [](View& view) {
         view.scene.kinds[0].segments = {{1, 2, 1}};
         view.scene.kinds[0].length_min = 0.8;
       },
       "length", warning, "shorter than known"},
      {"the intrinsics of another resolution",
       [](View& view) {
         view.scene.camera.width /= 2;
         view.scene.camera.height /= 2;
       },
       "camera", error, "outside of the camera's image"},
      {"an organized cloud of another resolution",
       [](View& view) {
         view.cloud = organized();
         Camera& camera = view.scene.camera;
         camera = {.width = camera.width / 2,
                   .height = camera.height / 2,
                   .fx = camera.fx / 2,
                   .fy = camera.fy / 2,
                   .cx = camera.cx / 2,
                   .cy = camera.cy / 2,
                   .pose = camera.pose};
       },
       "camera", warning, "800 x 600 pixels"},
      {"another camera at the same place",
       [](View& view) {
         view.scene.camera.fx *= 2;
         view.scene.camera.fy *= 2;
         view.scene.camera.width *= 2;
         view.scene.camera.height *= 2;
         view.scene.camera.cx *= 2;
         view.scene.camera.cy *= 2;
       },
       "camera", warning, "no neighbour"},
      {"a mirrored cloud", axes(-x, y, z), "camera", warning, "at several depths"},
      {"a mirrored organized cloud",
       [=](View& view) {
         view.cloud = organized();
         view.scene.camera.pose.translation().y() = 0;
         axes(-x, y, z)(view);
       },
       "camera", warning, "pixels beside"},
      {"every point twice",
       [](View& view) {
         const std::vector<Eigen::Vector3f> once = view.cloud.points;
         view.cloud.points.insert(view.cloud.points.end(), once.begin(), once.end());
         view.cloud.width *= 2;
       },
       "camera", warning, "2.0 points lie in each pixel"},
      {"an empty cloud", [](View& view) { view.cloud = {}; }, "empty", error, "no points"},
      {"only NaN",
       [](View& view) {
         view.cloud = cloud_of(std::vector<Eigen::Vector3f>(50, {nan, nan, nan}));
       },
       "invalid", error, "none of the cloud's 50 points has a position"},
      {"only the bin",
       [](View& view) {
         view.cloud =
             cloud_from_scan(scan({}, view.scene.support.bin, view.scene.camera), CloudOf::tubes_and_bin, 0);
       },
       "no-tubes", error, "it looks empty"},
      {"one plane",
       [](View& view) {
         std::vector<Eigen::Vector3f> points;
         for (int i = 0; i < 40'000; ++i)
           points.emplace_back(0.001F * static_cast<float>(i % 200) - 0.1F,
                               0.001F * static_cast<float>(i / 200) - 0.1F, 0.1F);
         view.cloud = cloud_of(points);
       },
       "no-tubes", error, "none of the 40000 points looked at"},
  };
}

}  // namespace tanglebin::test
