#include "tanglebin/cli/terminal/progress.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <vector>

namespace tanglebin::cli {
namespace {

TEST(RemainingTime, ACaseCountsAsManyTimesAsItHasTubes) {
  RemainingTime remaining;
  remaining.begin({{"A", 1, 1}, {"A", 4, 1}, {"A", 20, 1}});
  EXPECT_EQ(remaining.seconds(3), std::nullopt) << "before the first case";
  remaining.end({"A", 1, 1});
  EXPECT_EQ(remaining.seconds(1), 24);
  remaining.end({"A", 4, 1});
  EXPECT_EQ(remaining.seconds(5), 20);
  remaining.end({"A", 20, 1});
  EXPECT_EQ(remaining.seconds(25), 0);
}

// If a case of n tubes takes n times as long as one of one tube, the estimate is right from the first on.
RC_GTEST_PROP(RemainingTime, IsRightWhereTheTimeGrowsWithTheTubes, ()) {
  const auto tubes = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 30)));
  std::vector<CaseId> cases;
  double total = 0;
  for (const int number : tubes) {
    cases.push_back({"A", number, static_cast<int>(cases.size()) + 1});
    total += number;
  }
  RemainingTime remaining;
  remaining.begin(cases);
  double elapsed = 0;
  for (const CaseId& id : cases) {
    elapsed += id.tubes;
    remaining.end(id);
    RC_ASSERT(remaining.seconds(elapsed) == total - elapsed);
  }
}

// The times, s, of the lines in a log of a run that takes so long, when progress is steady and looked at
// every second.
std::vector<int> lines_of_run(int seconds) {
  LogSchedule schedule;
  std::vector<int> lines;
  for (int now = 0; now < seconds; ++now) {
    if (schedule.is_due(now, static_cast<double>(now) / seconds)) lines.push_back(now);
  }
  return lines;
}

TEST(LogSchedule, AShortRunHasNoLine) {
  EXPECT_EQ(lines_of_run(30), std::vector<int>{});
}

TEST(LogSchedule, LinesAreATenthOfTheRunApartAndAtLeastThirtySeconds) {
  EXPECT_EQ(lines_of_run(100), (std::vector<int>{30, 60, 90}));
  EXPECT_EQ(lines_of_run(1000), (std::vector<int>{100, 200, 300, 400, 500, 600, 700, 800, 900}));
}

TEST(LogSchedule, ALongRunHasALineEveryTenMinutes) {
  const std::vector<int> lines = lines_of_run(36'000);
  EXPECT_EQ(lines.size(), 59U);
  EXPECT_EQ(lines.front(), 600);
}

TEST(ProgressText, SaysWhatIsDoneWhatFailedAndWhatIsLeft) {
  RemainingTime remaining;
  RunProgress progress{.wanted = 640, .found = 100};
  EXPECT_EQ(progress_text(progress, remaining, 1), "100 of 640 cases");
  remaining.begin({{"A", 1, 1}, {"A", 9, 1}});
  remaining.end({"A", 1, 1});
  progress.made = 18;
  progress.failed = 2;
  progress.rejected = 3;
  EXPECT_EQ(progress_text(progress, remaining, 10),
            "120 of 640 cases, 2/s, 1 min 30 s left, 3 attempts rejected, 2 cases failed");
}

TEST(ProgressText, OneCaseIsNotOneCases) {
  RemainingTime remaining;
  remaining.begin({{"A", 1, 1}});
  EXPECT_EQ(progress_text({.wanted = 1}, remaining, 1), "0 of 1 case");
  const RunProgress failed{.wanted = 1, .failed = 1, .rejected = 1};
  EXPECT_THAT(progress_text(failed, remaining, 1), testing::HasSubstr("1 attempt rejected, 1 case failed"));
}

TEST(DurationText, HasTwoUnits) {
  EXPECT_EQ(duration_text(44.6), "45 s");
  EXPECT_EQ(duration_text(59.7), "1 min 00 s");
  EXPECT_EQ(duration_text(750), "12 min 30 s");
  EXPECT_EQ(duration_text(11'100), "3 h 05 min");
}

}  // namespace
}  // namespace tanglebin::cli
