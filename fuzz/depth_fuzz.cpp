// Any input is a depth image or an error with a message on one line. An image has as many depths as pixels,
// each positive or NaN, and so has its cloud.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "fuzz/is_refused.hpp"
#include "tanglebin/io/depth_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream file(std::string(data, data + size));
  tanglebin::DepthImage image{};
  if (is_refused([&] { image = tanglebin::read_depths(file, "depth", 1000); })) return 0;
  const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const bool are_depths = std::ranges::all_of(
      image.depths, [](float depth) { return std::isnan(depth) || (depth > 0 && std::isfinite(depth)); });
  if (image.depths.size() != pixels || !are_depths) std::abort();
  const tanglebin::Intrinsics camera{image.width, image.height, 500, 500, 0, 0};
  const tanglebin::PointCloud cloud = tanglebin::cloud_from_depths(image, camera);
  if (cloud.points.size() != pixels || cloud.width * cloud.height != pixels) std::abort();
  return 0;
}
