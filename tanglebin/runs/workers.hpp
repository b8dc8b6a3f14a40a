#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace tanglebin {

/// Does one task, in a worker process. What it returns is handed to the calling process; what else it makes
/// it leaves on disk.
using Task = std::function<std::string(std::size_t task)>;

/// Thrown by a task that cannot be done, now or later, where the others can.
class TaskImpossible : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// A task that is done.
struct TaskResult {
  std::size_t task;
  std::string text;  ///< what it returned
  double seconds;    ///< wall clock, from when it was handed out
};

/// A task that is given up.
struct TaskFailure {
  std::size_t task;
  std::string reason;  ///< it threw TaskImpossible, ended two workers or threw twice
};

/// What run_in_workers() tells, all of it in the calling process.
struct WorkersObserver {
  /// Tasks that are done since the last call. The workers have their next tasks by then, so that what this
  /// does holds up nobody.
  std::function<void(const std::vector<TaskResult>&)> done = [](const auto&) {};
  /// A task that is given up; the run goes on.
  std::function<void(const TaskFailure&)> failed = [](const auto&) {};
  /// A few times a second.
  std::function<void()> tick = [] {};
};

/// Runs tasks 0 … count − 1 in `jobs` forked processes. A worker gets the next task when it is done with its
/// last, so a slow task holds up nobody. A task that throws TaskImpossible is given up; one whose worker
/// dies, or that throws anything else but an InputError, is tried once more and then given up; all others are
/// done. Returns true when each task is done or given up, false when SIGINT or SIGTERM came: then the tasks
/// under way are finished and the others, if there were any, left. So they are when a task throws InputError,
/// which is thrown here then, and when an observer throws. Workers end with the calling process, whatever
/// ends it. Not to be called where other threads run: fork() leaves them behind.
bool run_in_workers(int jobs, std::size_t count, const Task& task, const WorkersObserver& observer);

}  // namespace tanglebin
