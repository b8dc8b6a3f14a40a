#pragma once

#include <unistd.h>

#include <chrono>
#include <cstddef>

namespace tanglebin::cli {

/// One line on the terminal that is written over and over: how many of the cases are done, and how long the
/// rest will take. Nothing where standard error is not a terminal.
class ProgressLine {
public:
  explicit ProgressLine(std::size_t total) : total_(total) {}
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(std::size_t done);

private:
  std::size_t total_;
  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  bool shown_ = false;
  std::size_t done_at_start_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Wall clock.
double seconds_since(std::chrono::steady_clock::time_point start);

}  // namespace tanglebin::cli
