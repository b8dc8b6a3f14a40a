// Replaces the room's sources that need the Point Cloud Library if it is not installed.
#include "tanglebin/base/error.hpp"
#include "tanglebin/model/paper/paper_method.hpp"

namespace tanglebin {

void expect_paper_method() {
  throw InputError({"", 0, "method"},
                   "the paper's method needs the Point Cloud Library, which this build lacks; use "
                   "--method axis, or run scripts/setup paper and build again");
}

PaperModel model_as_in_paper(const PointCloud& /*cloud*/, const KnownScene& /*known*/, double /*ratio*/,
                             std::uint64_t /*seed*/, const PaperSettings& /*settings*/,
                             const std::function<void()>& /*at_step*/) {
  expect_paper_method();
  return {};
}

}  // namespace tanglebin
