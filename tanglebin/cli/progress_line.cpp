#include "tanglebin/cli/progress_line.hpp"

#include <fmt/core.h>

namespace tanglebin::cli {

ProgressLine::~ProgressLine() {
  if (shown_) fmt::print(stderr, "\n");
}

void ProgressLine::show(std::size_t done) {
  if (!is_terminal_) return;
  if (!shown_) done_at_start_ = done;
  fmt::print(stderr, "\r{} of {} cases", done, total_);
  if (done > done_at_start_) {
    const double pace = static_cast<double>(done - done_at_start_) / seconds_since(start_);
    fmt::print(stderr, ", {:.2g} a second, {:.0f} s left", pace, static_cast<double>(total_ - done) / pace);
  }
  fmt::print(stderr, " \x1b[K");
  shown_ = true;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace tanglebin::cli
