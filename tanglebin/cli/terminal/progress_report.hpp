#pragma once

#include <unistd.h>

#include <chrono>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tanglebin/cli/terminal/progress.hpp"
#include "tanglebin/dataset/run_observer.hpp"

namespace CLI {
class App;
}

namespace tanglebin::cli {

/// How a command over many cases reports progress.
enum class ProgressStyle {
  line,  ///< on standard error: a line updated in place on a terminal, else a line now and then
  json,  ///< a line of JSON for each event on standard output (docs/formats.md)
};

/// Adds --progress, which sets `style`.
void add_progress_option(CLI::App& command, ProgressStyle& style);

/// Reports the progress of a run.
class ProgressReport {
public:
  explicit ProgressReport(ProgressStyle style) : style_(style) {}
  ~ProgressReport();  ///< ends the terminal's line
  ProgressReport(const ProgressReport&) = delete;
  ProgressReport& operator=(const ProgressReport&) = delete;

  /// The observer to pass to the run. Must not outlive the report.
  RunObserver observer();

private:
  using Clock = std::chrono::steady_clock;

  void show(const RunProgress& progress);
  void end(const CaseEvent& event);
  void show_line(const RunProgress& progress);
  void print_stopping() const;
  void log(const RunProgress& progress);
  void print_progress(const RunProgress& progress);
  static void print_end_of_case(const CaseEvent& event);

  ProgressStyle style_;
  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  bool is_shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_printed_{};
  RemainingTime remaining_;
  LogSchedule schedule_;
};

/// The counts of a run's cases: wanted, found, made, failed.
nlohmann::ordered_json counts_json(const RunProgress& run);

/// How many cases a run that was stopped has left: "; stopped, 3 to go".
std::string left_over(const RunProgress& run);

/// Wall-clock time since `start`, s.
double seconds_since(std::chrono::steady_clock::time_point start);

}  // namespace tanglebin::cli
