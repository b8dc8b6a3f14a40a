#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>

#include "fuzz/is_refused.hpp"
#include "tanglebin/cloud/cloud.hpp"

/// Reads an input, which is a cloud or an InputError. A cloud must be the same after writing and reading.
template <typename Read, typename Write>
void expect_same_cloud_again(const std::uint8_t* data, std::size_t size, const Read& read,
                             const Write& write) {
  std::istringstream file(std::string(data, data + size));
  tanglebin::PointCloud cloud;
  if (is_refused([&] { cloud = read(file, "fuzz"); })) return;
  // An exception from here on is a bug: the project cannot read what it writes.
  std::stringstream copy;
  write(copy, cloud);
  const tanglebin::PointCloud back = read(copy, "copy");
  const bool same_shape = back.width == cloud.width && back.height == cloud.height;
  const auto same_point = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return std::memcmp(a.data(), b.data(), sizeof(a)) == 0;  // also compares NaN
  };
  const bool same_points = std::ranges::equal(back.points, cloud.points, same_point);
  if (!same_shape || !same_points || back.labels != cloud.labels || back.colors != cloud.colors) std::abort();
}
