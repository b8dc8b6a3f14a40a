#include "tanglebin/runs/process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <thread>

#include "tests/support/processes.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using test::bytes_of;
using test::is_running;
using test::TemporaryDirectory;
using testing::EndsWith;
using testing::HasSubstr;

Process shell(const std::string& script) {
  return {.command = {"sh", "-c", script}, .environment = {"PATH=/usr/bin:/bin"}};
}

// The number of a process that a script has written to a file.
pid_t process_in(const std::filesystem::path& file) {
  while (!bytes_of(file).ends_with('\n')) std::this_thread::sleep_for(milliseconds(1));
  return std::stoi(bytes_of(file));
}

void wait_until_gone(pid_t process) {
  while (is_running(process)) std::this_thread::sleep_for(milliseconds(1));
}

TEST(Process, GivesInputAndTakesBackOutput) {
  const std::string large(1 << 20, 'x');  // more than a pipe holds
  const ProcessResult result = run_process({.command = {"cat"}, .input = large});
  EXPECT_EQ(result.end, ProcessEnd::exited);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, large);
  EXPECT_EQ(result.err, "");
}

TEST(Process, TellsHowItEndedAndWhatItComplainedOf) {
  const ProcessResult result = run_process(shell("echo trouble >&2; exit 3"));
  EXPECT_EQ(result.status, 3);
  EXPECT_EQ(result.err, "trouble\n");
  const ProcessResult killed = run_process(shell("kill -9 $$"));
  EXPECT_EQ(killed.end, ProcessEnd::killed);
  EXPECT_EQ(killed.status, SIGKILL);
}

TEST(Process, NoShellReadsItsArguments) {
  EXPECT_EQ(run_process({.command = {"printf", "%s", "$HOME `id` ; *"}}).out, "$HOME `id` ; *");
}

TEST(Process, HasTheEnvironmentAndTheDirectoryThatItIsGivenAndNoOpenFileOfOurs) {
  const TemporaryDirectory directory;
  Process process = shell("env; pwd; ls /proc/self/fd | wc -l");
  process.directory = directory.path();
  process.environment.emplace_back("COLOUR=red");
  const std::string out = run_process(process).out;
  EXPECT_THAT(out, HasSubstr("COLOUR=red\n"));
  EXPECT_EQ(out.find("HOME="), std::string::npos);
  // Standard input, output and error, and the directory that ls reads.
  EXPECT_THAT(out, EndsWith(std::filesystem::canonical(directory.path()).string() + "\n4\n"));
}

TEST(Process, TellsThatAProgramIsNotInstalled) {
  try {
    run_process({.command = {"tanglebin-no-such-program"}});
    FAIL() << "it ran";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
  }
}

TEST(Process, OfALongOutputTheEndIsKept) {
  Process process = shell("yes out | head -c 3000000; yes error | head -c 3000000 >&2; echo end >&2");
  process.output_max = 1000;
  const ProcessResult result = run_process(process);
  EXPECT_EQ(result.out.size(), 1000U);
  EXPECT_EQ(result.err.size(), 1000U);
  EXPECT_THAT(result.err, EndsWith("\nend\n"));
}

TEST(Process, OneThatTakesTooLongIsKilledWithAllThatItStarted) {
  const TemporaryDirectory directory;
  Process process = shell("sleep 1000 & echo $! >child; setsid sh -c 'echo $$ >other; sleep 1000' & wait");
  process.directory = directory.path();
  process.limits.time = milliseconds(500);
  EXPECT_EQ(run_process(process).end, ProcessEnd::too_slow);
  EXPECT_FALSE(is_running(process_in(directory / "child")));
  EXPECT_FALSE(is_running(process_in(directory / "other")));
}

TEST(Process, WhatItLeavesInTheBackgroundIsKilledWhenItEnds) {
  const TemporaryDirectory directory;
  Process process =
      shell("(setsid sh -c 'echo $$ >daemon; exec sleep 1000' &); while ! test -s daemon; do :; done");
  process.directory = directory.path();
  const ProcessResult result = run_process(process);
  EXPECT_EQ(result.end, ProcessEnd::exited);
  EXPECT_EQ(result.status, 0);
  EXPECT_FALSE(is_running(process_in(directory / "daemon")));
}

TEST(Process, ItEndsWithTheProcessThatStartedItEvenIfThatIsKilled) {
  const TemporaryDirectory directory;
  const pid_t caller = fork();
  if (caller == 0) {
    Process process = shell("setsid sleep 1000 & echo $! >background; echo $$ >program; sleep 1000");
    process.directory = directory.path();
    run_process(process);
    _exit(0);
  }
  const pid_t program = process_in(directory / "program");
  const pid_t background = process_in(directory / "background");
  EXPECT_TRUE(is_running(program));
  kill(caller, SIGKILL);
  waitpid(caller, nullptr, 0);
  wait_until_gone(program);
  wait_until_gone(background);
}

TEST(Process, OneThatFloodsTheDiskIsStopped) {
  const TemporaryDirectory directory;
  for (const char* flood : {"exec head -c 100000000 /dev/zero >large",
                            "i=0; while :; do head -c 500000 /dev/zero >small$i; i=$((i+1)); done"}) {
    Process process = shell(flood);
    process.directory = directory.path();
    process.limits.disk = 1 << 20;
    process.limits.time = minutes(1);
    EXPECT_EQ(run_process(process).end, ProcessEnd::too_large) << flood;
  }
}

TEST(Process, OneThatTakesTooMuchMemoryDoesNotGetIt) {
#ifdef TANGLEBIN_SANITIZE
  GTEST_SKIP() << "sanitizers need more address space than that";
#endif
  Process process = shell("head -c 300000000 /dev/zero | tail -c 290000000 >/dev/null");
  EXPECT_EQ(run_process(process).status, 0);
  process.limits.memory = 100 << 20;
  const ProcessResult result = run_process(process);
  EXPECT_NE(result.status, 0);
  EXPECT_THAT(result.err, HasSubstr("memory"));
}

}  // namespace
}  // namespace tanglebin
