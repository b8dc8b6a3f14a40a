#pragma once

#include <unistd.h>

#include <chrono>
#include <string>

#include "tanglebin/dataset/run_observer.hpp"

namespace CLI {
class App;
}

namespace tanglebin::cli {

/// How a command over many cases tells how far it is.
enum class ProgressStyle {
  line,  ///< on a terminal's standard error, one line that is written over and over; elsewhere nothing
  json,  ///< on standard output, a line of JSON for each event (docs/formats.md)
};

/// Adds --progress, which sets `style`.
void add_progress_option(CLI::App& command, ProgressStyle& style);

/// Tells how far a run is.
class ProgressReport {
public:
  explicit ProgressReport(ProgressStyle style) : style_(style) {}
  ~ProgressReport();  ///< leaves the terminal's line as it is and begins a new one
  ProgressReport(const ProgressReport&) = delete;
  ProgressReport& operator=(const ProgressReport&) = delete;

  /// What the run is to tell; not to be used after the report.
  RunObserver observer();

private:
  using Clock = std::chrono::steady_clock;

  double rate(const RunProgress& progress) const;
  void show_line(const RunProgress& progress);
  void print_progress(const RunProgress& progress);
  static void print_end_of_case(const CaseEvent& event);

  ProgressStyle style_;
  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  bool is_shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_printed_{};
};

/// A time as a person says it: "45 s", "12 min 30 s", "3 h 05 min".
std::string duration_text(double seconds);

/// Wall clock.
double seconds_since(std::chrono::steady_clock::time_point start);

}  // namespace tanglebin::cli
