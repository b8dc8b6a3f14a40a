#include "tanglebin/cli/terminal/progress.hpp"

#include <fmt/core.h>

#include <cmath>

#include "tanglebin/report/text.hpp"

namespace tanglebin::cli {

void RemainingTime::begin(const std::vector<CaseId>& cases) {
  for (const CaseId& id : cases) tubes_to_go_ += id.tubes;
}

void RemainingTime::end(const CaseId& id) {
  tubes_ended_ += id.tubes;
  tubes_to_go_ -= id.tubes;
}

std::optional<double> RemainingTime::seconds(double elapsed) const {
  if (tubes_ended_ == 0) return std::nullopt;
  return elapsed * tubes_to_go_ / tubes_ended_;
}

bool LogSchedule::is_due(double elapsed, double share) {
  constexpr double shortest = 30;
  constexpr double longest = 600;
  const double pause = elapsed - last_time_;
  const int tenths = static_cast<int>(10 * share);
  if (pause < shortest || (pause < longest && tenths == last_tenths_)) return false;
  last_time_ = elapsed;
  last_tenths_ = tenths;
  return true;
}

std::size_t ended(const RunProgress& progress) {
  return progress.made + progress.failed;
}

double rate(const RunProgress& progress, double elapsed) {
  return static_cast<double>(ended(progress)) / elapsed;
}

std::string progress_text(const RunProgress& progress, const RemainingTime& remaining, double elapsed) {
  std::string text =
      fmt::format("{} of {}", progress.found + ended(progress), counted(progress.wanted, "case"));
  if (const auto seconds = remaining.seconds(elapsed))
    text += fmt::format(", {:.2g}/s, {} left", rate(progress, elapsed), duration_text(*seconds));
  if (progress.rejected > 0) text += fmt::format(", {} rejected", counted(progress.rejected, "attempt"));
  if (progress.failed > 0) text += fmt::format(", {} failed", counted(progress.failed, "case"));
  return text;
}

std::string duration_text(double seconds) {
  constexpr long in_minute = 60;
  constexpr long in_hour = 3600;
  const long whole = std::lround(seconds);
  if (whole < in_minute) return fmt::format("{} s", whole);
  if (whole < in_hour) return fmt::format("{} min {:02} s", whole / in_minute, whole % in_minute);
  return fmt::format("{} h {:02} min", whole / in_hour, whole % in_hour / in_minute);
}

}  // namespace tanglebin::cli
