#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <string>

#include "fuzz/expect_same_cloud_again.hpp"
#include "tanglebin/io/pcd.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  expect_same_cloud_again(
      data, size, [](std::istream& in, const std::string& name) { return tanglebin::read_pcd(in, name); },
      [](std::ostream& out, const tanglebin::PointCloud& cloud) { tanglebin::write_pcd(out, cloud); });
  return 0;
}
