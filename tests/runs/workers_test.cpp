#include "tanglebin/runs/workers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tanglebin/base/error.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/processes.hpp"
#include "tests/support/temporary_directory.hpp"

namespace tanglebin {
namespace {

using test::bytes_of;
using test::files_below;
using test::TemporaryDirectory;
using test::write_bytes;

// A task that leaves a file named after it, with the process that did it inside.
Task leave_a_file(const TemporaryDirectory& directory) {
  return [&directory](std::size_t task) {
    usleep(2000);
    write_bytes(directory / std::to_string(task), std::to_string(getpid()));
    return std::string();
  };
}

/// What an observer was told.
struct Heard {
  std::map<std::size_t, std::string> done;
  std::map<std::size_t, std::string> failed;

  WorkersObserver observer() {
    return {.done =
                [this](const std::vector<TaskResult>& results) {
                  for (const TaskResult& result : results) done[result.task] += result.text;
                },
            .failed = [this](const TaskFailure& failure) { failed[failure.task] += failure.reason; }};
  }
};

TEST(Workers, DoEveryTaskOnceInProcessesOfTheirOwn) {
  const TemporaryDirectory directory;
  EXPECT_TRUE(run_in_workers(3, 50, leave_a_file(directory), {}));
  const auto files = files_below(directory.path());
  EXPECT_EQ(files.size(), 50U);
  std::set<std::string> processes;
  for (const auto& [task, process] : files) processes.insert(process);
  EXPECT_LE(processes.size(), 3U);
  EXPECT_FALSE(processes.contains(std::to_string(getpid())));
}

TEST(Workers, HandWhatATaskReturnsToTheCallingProcessWhateverItsSize) {
  Heard heard;
  run_in_workers(
      2, 4, [](std::size_t task) { return std::string(task * 1000000, 'x'); }, heard.observer());
  ASSERT_EQ(heard.done.size(), 4U);
  for (const auto& [task, text] : heard.done) EXPECT_EQ(text, std::string(task * 1000000, 'x'));
}

TEST(Workers, ASlowTaskHoldsUpNobody) {
  const TemporaryDirectory directory;
  const Task leave = leave_a_file(directory);
  // The first task waits for the last one, which its own worker can thus not be the one to do.
  EXPECT_TRUE(run_in_workers(2, 20,
                             [&](std::size_t task) {
                               while (task == 0 && !std::filesystem::exists(directory / "19")) usleep(1000);
                               return leave(task);
                             },
                             {}));
  EXPECT_EQ(files_below(directory.path()).size(), 20U);
}

TEST(Workers, NoTasksAreSoonDone) {
  EXPECT_TRUE(run_in_workers(2, 0, [](std::size_t) { return std::string(); }, {}));
}

TEST(Workers, BadInputStopsTheRunAndKeepsItsMessage) {
  const TemporaryDirectory directory;
  const Task leave = leave_a_file(directory);
  const auto run = [&] {
    run_in_workers(2, 1000,
                   [&](std::size_t task) {
                     if (task == 5) throw InputError({"x.ply", 3, "label"}, "7.5", "an integer");
                     return leave(task);
                   },
                   {});
  };
  EXPECT_EQ(test::complaint(run), "x.ply:3: label: found 7.5, expected an integer");
  EXPECT_LT(files_below(directory.path()).size(), 100U);
}

TEST(Workers, ATaskThatEndsItsWorkerTwiceIsGivenUpAndTheOthersAreDone) {
  Heard heard;
  const bool all = run_in_workers(
      2, 100,
      [](std::size_t task) {
        if (task % 40 == 3) kill(getpid(), SIGABRT);
        if (task == 50) _exit(7);
        return std::string("done");
      },
      heard.observer());
  EXPECT_TRUE(all);
  EXPECT_EQ(heard.done.size(), 96U);
  const std::string reason = "its worker was ended by signal 6, the second time";
  EXPECT_EQ(
      heard.failed,
      (std::map<std::size_t, std::string>{
          {3, reason}, {43, reason}, {83, reason}, {50, "its worker ended with status 7, the second time"}}));
}

TEST(Workers, ATaskWhoseWorkerDiesOnceIsDoneByAnother) {
  const TemporaryDirectory directory;
  Heard heard;
  run_in_workers(
      1, 10,
      [&](std::size_t task) {
        const std::string mark = "tried " + std::to_string(task);
        const bool is_first_try = !std::filesystem::exists(directory / mark);
        write_bytes(directory / mark, "");
        if (is_first_try && task % 2 == 0) kill(getpid(), SIGKILL);
        return std::to_string(task);
      },
      heard.observer());
  EXPECT_TRUE(heard.failed.empty());
  ASSERT_EQ(heard.done.size(), 10U);
  for (const auto& [task, text] : heard.done) EXPECT_EQ(text, std::to_string(task));
}

TEST(Workers, AnExceptionIsTriedOnceMoreButNotWhatIsImpossible) {
  const TemporaryDirectory directory;
  Heard heard;
  run_in_workers(
      1, 3,
      [&](std::size_t task) -> std::string {
        write_bytes(directory / std::to_string(task), bytes_of(directory / std::to_string(task)) + "x");
        if (task == 0) throw std::logic_error("bad luck");
        if (task == 1) throw TaskImpossible("no way");
        return "done";
      },
      heard.observer());
  EXPECT_EQ(heard.failed,
            (std::map<std::size_t, std::string>{{0, "bad luck, the second time"}, {1, "no way"}}));
  EXPECT_EQ(files_below(directory.path()),
            (std::map<std::string, std::string>{{"0", "xx"}, {"1", "x"}, {"2", "x"}}));
}

TEST(Workers, ATaskThatNeedsTooMuchMemoryIsGivenUpAndTheOthersAreDone) {
  Heard heard;
  const auto need_memory = [](std::size_t task) {
    if (task == 1) throw std::bad_alloc();
    return std::string("done");
  };
  EXPECT_TRUE(run_in_workers(1, 3, need_memory, heard.observer()));
  EXPECT_EQ(heard.done.size(), 2U);
  EXPECT_EQ(heard.failed, (std::map<std::size_t, std::string>{{1, "out of memory, the second time"}}));
}

TEST(Workers, ARefusalOfTheSystemEndsTheRunAsWhatItIs) {
  const auto refuse = [](std::size_t) -> std::string { throw SystemError("1.ply", "cannot write: full"); };
  EXPECT_THAT([&] { run_in_workers(1, 3, refuse, {}); },
              testing::ThrowsMessage<SystemError>("1.ply: cannot write: full"));
}

TEST(Workers, OnAnInterruptTheTasksUnderWayAreFinishedAndTheRestLeft) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryDirectory directory;
    const pid_t parent = getpid();
    const bool complete = run_in_workers(2, 1000,
                                         [&](std::size_t task) {
                                           if (task == 10) kill(parent, signal);
                                           return leave_a_file(directory)(task);
                                         },
                                         {});
    EXPECT_FALSE(complete);
    EXPECT_EQ(interrupting_signal(), signal);
    const std::size_t done = files_below(directory.path()).size();
    EXPECT_GT(done, 10U);  // the task that interrupted was finished too
    EXPECT_LT(done, 1000U);
  }
}

TEST(Workers, ATaskUnderWayStopsOnAnInterruptWhereItAsks) {
  const pid_t parent = getpid();
  Heard heard;
  int told = 0;
  WorkersObserver observer = heard.observer();
  observer.stopping = [&] { ++told; };
  const bool complete = run_in_workers(
      2, 10,
      [&](std::size_t task) -> std::string {
        if (task == 0) kill(parent, SIGTERM);
        while (true) {
          usleep(1000);
          stop_if_asked();
        }
      },
      observer);
  EXPECT_FALSE(complete);
  EXPECT_EQ(told, 1);
  EXPECT_TRUE(heard.done.empty());
  EXPECT_TRUE(heard.failed.empty());
}

TEST(Workers, ASecondInterruptEndsThemAtOnce) {
  const pid_t parent = getpid();
  Heard heard;
  const bool complete = run_in_workers(
      2, 10,
      [&](std::size_t task) -> std::string {
        while (true) {  // until it is killed
          if (task == 0) kill(parent, SIGINT);
          usleep(100'000);
        }
      },
      heard.observer());
  EXPECT_FALSE(complete);
  EXPECT_TRUE(heard.done.empty());
  EXPECT_TRUE(heard.failed.empty());
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no worker is left
}

TEST(Workers, ASecondInterruptAlsoEndsARunWithAnAnswerThatNobodyHasRead) {
  const pid_t parent = getpid();
  Heard heard;
  WorkersObserver observer = heard.observer();
  // Long enough for the answer to arrive, and for the second signal to count as another wish.
  observer.stopping = [] {
    usleep(700'000);
    raise(SIGINT);
  };
  const bool complete = run_in_workers(
      1, 10,
      [&](std::size_t) -> std::string {
        kill(parent, SIGINT);
        usleep(200'000);  // the signal is handled first
        return "done";
      },
      observer);
  EXPECT_FALSE(complete);
  EXPECT_EQ(interrupting_signal(), SIGINT);
  EXPECT_TRUE(heard.done.empty());
  EXPECT_TRUE(heard.failed.empty());
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no worker is left
}

TEST(Workers, ATaskThatTakesTooLongIsGivenUpAndTheOthersAreDone) {
  Heard heard;
  const bool all = run_in_workers(
      1, 4,
      [](std::size_t task) {
        while (task == 1) pause();
        return std::string("done");
      },
      heard.observer(), std::chrono::seconds(1));
  EXPECT_TRUE(all);
  EXPECT_EQ(heard.done.size(), 3U);
  EXPECT_EQ(heard.failed, (std::map<std::size_t, std::string>{{1, "took longer than 1 s"}}));
}

TEST(Workers, AnErrorOfTheCallersOwnEndsTheRunWithTheTasksUnderWayFinished) {
  const TemporaryDirectory directory;
  const WorkersObserver full{.done = [](const auto&) { throw InputError({"journal", 0, ""}, "full"); }};
  EXPECT_EQ(test::complaint([&] { run_in_workers(2, 1000, leave_a_file(directory), full); }),
            "journal: full");
  EXPECT_LT(files_below(directory.path()).size(), 100U);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no worker is left
}

TEST(Workers, EndWithTheProcessThatCalledThemWhateverEndsIt) {
  const TemporaryDirectory directory;
  const pid_t caller = fork();
  if (caller == 0) {
    run_in_workers(2, 2,
                   [&](std::size_t task) -> std::string {
                     write_bytes(directory / std::to_string(task), std::to_string(getpid()));
                     while (true) usleep(1000);
                   },
                   {});
    _exit(0);
  }
  std::vector<pid_t> workers;
  for (const std::string file : {"0", "1"}) {
    while (bytes_of(directory / file).empty()) usleep(1000);
    usleep(10000);  // a number of several digits is there at once, but not for sure
    workers.push_back(std::stoi(bytes_of(directory / file)));
  }
  kill(caller, SIGKILL);
  waitpid(caller, nullptr, 0);
  for (const pid_t worker : workers) {
    while (test::is_running(worker)) usleep(1000);
  }
}

}  // namespace
}  // namespace tanglebin
