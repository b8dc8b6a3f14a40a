// Any input is labels or an error with a message on one line. Labels are at least −1, and no more than the
// input has bytes.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "fuzz/is_refused.hpp"
#include "tanglebin/io/labels.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream file(std::string(data, data + size));
  tanglebin::GivenLabels labels;
  if (is_refused([&] { labels = tanglebin::read_labels(file, "labels"); })) return 0;
  if (const auto* cloud = std::get_if<tanglebin::PointCloud>(&labels)) {
    tanglebin::check_cloud(*cloud);
    return 0;
  }
  const auto& in_order = std::get<std::vector<std::int32_t>>(labels);
  const bool are_labels = std::ranges::all_of(in_order, [](std::int32_t label) { return label >= -1; });
  if (!are_labels || in_order.size() > size) std::abort();
  return 0;
}
