// In place of the room's other sources where the Point Cloud Library is not installed.
#include "tanglebin/base/error.hpp"
#include "tanglebin/model/paper/paper_method.hpp"

namespace tanglebin {

void expect_paper_method() {
  throw InputError({"", 0, "method"}, "paper, which needs the Point Cloud Library",
                   "axis; or run scripts/setup paper and build again");
}

PaperModel model_as_in_paper(const PointCloud& /*cloud*/, const KnownScene& /*known*/, double /*ratio*/,
                             std::uint64_t /*seed*/, const PaperSettings& /*settings*/) {
  expect_paper_method();
  return {};
}

}  // namespace tanglebin
