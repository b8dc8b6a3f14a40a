#include "tanglebin/report/process.hpp"

#include <gtest/gtest.h>

#include <system_error>

namespace tanglebin {
namespace {

TEST(Process, GivesInputAndTakesBackOutput) {
  const std::string large(1 << 20, 'x');  // more than a pipe holds
  const ProcessResult result = run_process({"cat"}, large);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, large);
  EXPECT_EQ(result.err, "");
}

TEST(Process, TellsHowItEndedAndWhatItComplainedOf) {
  const ProcessResult result = run_process({"sh", "-c", "echo trouble >&2; exit 3"}, "");
  EXPECT_EQ(result.status, 3);
  EXPECT_EQ(result.err, "trouble\n");
  EXPECT_EQ(run_process({"sh", "-c", "kill -9 $$"}, "").status, -1);
}

TEST(Process, NoShellReadsItsArguments) {
  EXPECT_EQ(run_process({"printf", "%s", "$HOME `id` ; *"}, "").out, "$HOME `id` ; *");
}

TEST(Process, TellsThatAProgramIsNotInstalled) {
  try {
    run_process({"tanglebin-no-such-program"}, "");
    FAIL() << "it ran";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
  }
}

}  // namespace
}  // namespace tanglebin
