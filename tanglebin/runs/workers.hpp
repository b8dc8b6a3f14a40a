#pragma once

#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tanglebin {

/// Does one task in a worker process. The returned text goes to the calling process; other results stay on
/// the disk.
using Task = std::function<std::string(std::size_t task)>;

/// Thrown by a task that can never be done, although others can.
class TaskImpossible : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// For a task that takes long to call now and then. Throws TaskStopped in a worker if its run is to stop; the
/// task, which should let it through, is then left for the next run.
void stop_if_asked();
class TaskStopped : public std::exception {};

/// A task that is done.
struct TaskResult {
  std::size_t task;
  std::string text;  ///< what it returned
  double seconds;    ///< wall clock, from when it was handed out
};

/// A task that is given up.
struct TaskFailure {
  std::size_t task;
  std::string reason;  ///< it threw TaskImpossible, took too long, ended two workers or threw twice
};

/// What run_in_workers() reports, always in the calling process.
struct WorkersObserver {
  /// Tasks done since the last call. The workers already have their next tasks, so this keeps none of them
  /// waiting.
  std::function<void(const std::vector<TaskResult>&)> done = [](const auto&) {};
  /// A task that is given up; the run goes on.
  std::function<void(const TaskFailure&)> failed = [](const auto&) {};
  /// A few times a second.
  std::function<void()> tick = [] {};
  /// After the first SIGINT or SIGTERM.
  std::function<void()> stopping = [] {};
};

/// The wall-clock time that a task may take.
using TimeLimit = std::chrono::steady_clock::duration;
inline constexpr TimeLimit no_limit = TimeLimit::max();

/// Throws InputError unless there may be so many worker processes, 1 to 1024.
void validate_jobs(int jobs);

/// Runs tasks 0 … count − 1 in `jobs` forked processes. A worker gets its next task as soon as it has done
/// the last, so a slow task delays no other. A task that throws TaskImpossible is given up. One whose worker
/// dies, or that throws anything but an InputError or a SystemError, is tried once more and then given up.
/// One that takes longer than `limit` is given up and its worker killed. Returns true when each task is done
/// or given up; false after SIGINT or SIGTERM, when the running tasks are finished or stopped and the rest is
/// left. Another such signal, half a second later or more, kills the workers. The same as after the first
/// happens if a task throws InputError or SystemError, which is then thrown here, and if an observer throws.
/// Workers end with the calling process, whatever ends it. Do not call it while other threads run: fork()
/// does not copy them.
bool run_in_workers(int jobs, std::size_t count, const Task& task, const WorkersObserver& observer,
                    TimeLimit limit = no_limit);

/// The signal that interrupted the last call of run_in_workers(): SIGINT or SIGTERM; 0 if none did.
int interrupting_signal();

}  // namespace tanglebin
