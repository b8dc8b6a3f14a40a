#include "tanglebin/scene/read_measurement.hpp"

#include <fstream>
#include <optional>

#include "tanglebin/base/error.hpp"
#include "tanglebin/files/read_file.hpp"
#include "tanglebin/io/cloud_input.hpp"
#include "tanglebin/io/depth_input.hpp"
#include "tanglebin/io/read_cloud.hpp"

namespace tanglebin {
namespace {

std::optional<double> steps_per_metre(const SceneCamera& camera) {
  constexpr double thousand = 1000;
  if (camera.depth_scale) return camera.depth_scale;
  return camera.unit && *camera.unit < 1 ? std::optional(thousand) : std::nullopt;
}

DepthImage read_depths_of(std::istream& in, const std::string& name, const SceneCamera& camera) {
  try {
    return read_depths(in, name, steps_per_metre(camera), 1 / camera.unit.value_or(1));
  } catch (const InputError& error) {
    if (error.place().field != "steps per metre") throw;
    throw InputError({name, 0, "depth_scale"}, "nothing that says what the image's numbers are",
                     "--unit mm if they are millimetres; or their number per metre: depth_scale in the scene "
                     "file's [camera]");
  }
}

Measurement read_depth_measurement(std::istream& in, const std::string& name, Scene scene) {
  SceneCamera& camera = scene.camera;
  if (!camera.intrinsics)
    throw InputError({name, 0, "camera"}, "a depth image, and nothing of the camera that took it",
                     "--camera FILE (of ROS, Open3D, BOP or `tanglebin scan --depth`), or a scene file with "
                     "[camera]");
  const DepthImage depths = read_depths_of(in, name, camera);
  if (camera.intrinsics->width == 0) {
    camera.intrinsics->width = depths.width;
    camera.intrinsics->height = depths.height;
  }
  camera.frame = CloudFrame::camera;
  camera.unit = 1;
  return {with_file(name, [&] { return cloud_from_depths(depths, *camera.intrinsics); }), scene};
}

}  // namespace

Measurement read_measurement(std::istream& in, const std::string& name, const Scene& scene) {
  if (is_depth_image(in)) return read_depth_measurement(in, name, scene);
  return {read_cloud(in, name), scene};
}

Measurement read_measurement(const std::filesystem::path& file, const Scene& scene) {
  std::ifstream in = open_input(file);
  return read_measurement(in, file.string(), scene);
}

}  // namespace tanglebin
