// Any input is a camera file or an InputError. A camera must be fit for a scene file.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "fuzz/is_refused.hpp"
#include "tanglebin/scene/camera_file.hpp"
#include "tanglebin/scene/read_scene.hpp"
#include "tanglebin/scene/write_scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tanglebin::Scene scene;
  if (is_refused(
          [&] { scene.camera = tanglebin::read_camera_text(std::string(data, data + size), "fuzz", 1); }))
    return 0;
  std::stringstream file;
  tanglebin::write_scene(file, scene);
  const tanglebin::Scene back = tanglebin::read_scene(file, "copy", ".");
  if (back.camera.intrinsics != scene.camera.intrinsics ||
      back.camera.depth_scale != scene.camera.depth_scale)
    std::abort();
  return 0;
}
