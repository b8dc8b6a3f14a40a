#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/dataset/run_observer.hpp"

// What the progress of a run over many cases means. Knows no clock: `elapsed` is the time since the run
// began, s.
namespace tanglebin::cli {

/// How long a run still takes. A case counts as many times as it has tubes: datasets begin with few tubes,
/// which are quick.
class RemainingTime {
public:
  /// The run begins, with these cases to do.
  void begin(const std::vector<CaseId>& cases);

  /// A case has ended.
  void end(const CaseId& id);

  /// The time to the end, s. None before the first case has ended.
  std::optional<double> seconds(double elapsed) const;

private:
  double tubes_ended_ = 0;
  double tubes_to_go_ = 0;
};

/// When to print a line of progress to a log: for every tenth of the cases and every ten minutes, but not
/// twice in 30 s.
class LogSchedule {
public:
  /// Whether to print a line now, after this share of the cases. It then counts as printed.
  bool is_due(double elapsed, double share);

private:
  double last_time_ = 0;
  int last_tenths_ = 0;
};

/// Cases that have ended in this run.
std::size_t ended(const RunProgress& progress);

/// Cases that have ended in this run per second.
double rate(const RunProgress& progress, double elapsed);

/// One line without its end: "120 of 640 cases, 2.1/s, 4 min 08 s left, 3 attempts rejected, 1 cases failed".
std::string progress_text(const RunProgress& progress, const RemainingTime& remaining, double elapsed);

/// A readable duration: "45 s", "12 min 30 s", "3 h 05 min".
std::string duration_text(double seconds);

}  // namespace tanglebin::cli
