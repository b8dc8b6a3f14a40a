#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/report/synthetic_results.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::ProgramResult;
using test::run_program;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class ReportCommand : public testing::Test {
protected:
  ReportCommand() {
    test::write_synthetic_results(directory_.path(), {.sets = {"A"}, .tubes = {2, 10}, .cases = 2});
  }

  ProgramResult report(const std::string& out) const {
    return run_program("report " + directory_.path().string() + " --out " + out);
  }

  test::TemporaryDirectory directory_;
};

TEST_F(ReportCommand, WritesThePageAndNothingElse) {
  const std::string page = (directory_ / "report.html").string();
  const ProgramResult result = report(page);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out + result.err, "");
  EXPECT_THAT(test::bytes_of(page), StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(test::bytes_of(page), EndsWith("</html>\n"));
}

TEST_F(ReportCommand, OnStandardOutputOnlyTheCommandThatMakesThePageDiffers) {
  const std::string file = (directory_ / "report.html").string();
  report(file);
  std::string page = test::bytes_of(file);
  const std::size_t place = page.find("--out " + file);
  ASSERT_NE(place, std::string::npos);
  page.replace(place, ("--out " + file).size(), "--out -");
  EXPECT_TRUE(report("-").out == page);
}

TEST_F(ReportCommand, ABadLineIsBadInput) {
  test::write_bytes(directory_ / "times.jsonl", "{}\n");
  const ProgramResult result = report((directory_ / "report.html").string());
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("times.jsonl:1: set: is missing\n"));
  EXPECT_FALSE(std::filesystem::exists(directory_ / "report.html"));
}

TEST_F(ReportCommand, ADirectoryOfAnotherKindIsBadInput) {
  EXPECT_EQ(run_program("report /nowhere --out page.pdf").err,
            "tanglebin: --out: found 'page.pdf', expected a name that ends in .html\n");
  const ProgramResult result = run_program("report /nowhere --out -");
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("/nowhere/experiment.json: is missing"));
}

TEST_F(ReportCommand, HelpHasAnExample) {
  EXPECT_THAT(run_program("report --help").out, HasSubstr("tanglebin report results --out report.html"));
}

}  // namespace
}  // namespace tanglebin
