#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>

#include "tanglebin/base/error.hpp"
#include "tanglebin/io/ply.hpp"

// Any input is a cloud or an InputError. A cloud must be the same after writing and reading.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream file(std::string(reinterpret_cast<const char*>(data), size));
  tanglebin::PointCloud cloud;
  try {
    cloud = tanglebin::read_ply(file, "fuzz.ply");
  } catch (const tanglebin::InputError&) {
    return 0;
  }
  std::stringstream copy;
  tanglebin::write_ply(copy, cloud);
  const tanglebin::PointCloud back = tanglebin::read_ply(copy, "copy.ply");
  const bool same_shape = back.width == cloud.width && back.height == cloud.height;
  const auto same_point = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return std::memcmp(a.data(), b.data(), sizeof(a)) == 0;  // also compares NaN
  };
  const bool same_points = std::ranges::equal(back.points, cloud.points, same_point);
  if (!same_shape || !same_points || back.labels != cloud.labels || back.colors != cloud.colors) std::abort();
  return 0;
}
