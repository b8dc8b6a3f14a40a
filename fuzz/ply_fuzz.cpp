#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <string>

#include "fuzz/expect_same_cloud_again.hpp"
#include "tanglebin/io/ply.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  expect_same_cloud_again(
      data, size, [](std::istream& in, const std::string& name) { return tanglebin::read_ply(in, name); },
      [](std::ostream& out, const tanglebin::PointCloud& cloud) { tanglebin::write_ply(out, cloud); });
  return 0;
}
