#include "tanglebin/dataset/workers.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <set>
#include <stdexcept>
#include <string>

#include "../support/temporary_directory.hpp"
#include "tanglebin/base/error.hpp"

namespace tanglebin {
namespace {

using test::files_below;
using test::TemporaryDirectory;
using test::write_bytes;

constexpr auto no_progress = [](std::size_t) {};

// A task that leaves a file named after it, with the process that did it inside.
Task leave_a_file(const TemporaryDirectory& directory) {
  return [&directory](std::size_t task) {
    usleep(2000);
    write_bytes(directory / std::to_string(task), std::to_string(getpid()));
  };
}

TEST(Workers, DoEveryTaskOnceInProcessesOfTheirOwn) {
  const TemporaryDirectory directory;
  std::size_t last = 0;
  EXPECT_TRUE(run_in_workers(3, 50, leave_a_file(directory), [&](std::size_t done) { last = done; }));
  EXPECT_EQ(last, 50U);
  const auto files = files_below(directory.path());
  EXPECT_EQ(files.size(), 50U);
  std::set<std::string> processes;
  for (const auto& [task, process] : files) processes.insert(process);
  EXPECT_LE(processes.size(), 3U);
  EXPECT_FALSE(processes.contains(std::to_string(getpid())));
}

TEST(Workers, NoTasksAreSoonDone) {
  EXPECT_TRUE(run_in_workers(
      2, 0, [](std::size_t) { FAIL(); }, no_progress));
}

TEST(Workers, BadInputStopsTheRunAndKeepsItsMessage) {
  const TemporaryDirectory directory;
  const Task leave = leave_a_file(directory);
  try {
    run_in_workers(
        2, 1000,
        [&](std::size_t task) {
          if (task == 5) throw InputError({"x.ply", 3, "label"}, "7.5", "an integer");
          leave(task);
        },
        no_progress);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "x.ply:3: label: found 7.5, expected an integer");
  }
  EXPECT_LT(files_below(directory.path()).size(), 100U);
}

TEST(Workers, AnyOtherExceptionIsARuntimeError) {
  try {
    run_in_workers(
        2, 10, [](std::size_t) { throw std::logic_error("impossible"); }, no_progress);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "impossible");
  }
}

TEST(Workers, TheDeathOfAWorkerIsAFailure) {
  try {
    run_in_workers(
        2, 100,
        [](std::size_t task) {
          if (task == 3) kill(getpid(), SIGKILL);
        },
        no_progress);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "a worker was ended by signal 9");
  }
}

TEST(Workers, OnAnInterruptTheTasksUnderWayAreFinishedAndTheRestLeft) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryDirectory directory;
    const pid_t parent = getpid();
    const bool complete = run_in_workers(
        2, 1000,
        [&](std::size_t task) {
          if (task == 10) kill(parent, signal);
          leave_a_file(directory)(task);
        },
        no_progress);
    EXPECT_FALSE(complete);
    const std::size_t done = files_below(directory.path()).size();
    EXPECT_GT(done, 10U);  // the task that interrupted was finished too
    EXPECT_LT(done, 1000U);
  }
}

}  // namespace
}  // namespace tanglebin
