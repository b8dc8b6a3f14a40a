#include "tanglebin/cli/progress_line.hpp"

#include <fmt/core.h>

namespace tanglebin::cli {

ProgressLine::~ProgressLine() {
  if (shown_) fmt::print(stderr, "\n");
}

void ProgressLine::show(std::size_t done) {
  if (!is_terminal_) return;
  if (!shown_) done_at_start_ = done;
  const std::size_t made = done - done_at_start_;
  const double elapsed = seconds_since(start_);
  const double remaining =
      made == 0 ? 0.0 : elapsed / static_cast<double>(made) * static_cast<double>(total_ - done);
  fmt::print(stderr, "\r{} of {} cases, {:.1f} a second, {:.0f} s left \x1b[K", done, total_,
             static_cast<double>(made) / elapsed, remaining);
  shown_ = true;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace tanglebin::cli
