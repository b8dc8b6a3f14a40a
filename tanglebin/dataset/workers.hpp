#pragma once

#include <cstddef>
#include <functional>

namespace tanglebin {

/// Does one task, in a worker process; what it makes it leaves on disk.
using Task = std::function<void(std::size_t task)>;

/// Told, in the calling process and a few times a second, how many tasks are done.
using Progress = std::function<void(std::size_t done)>;

/// Runs tasks 0 … count − 1 in `jobs` forked processes. A worker takes the next task when it is done with its
/// last, so a slow task holds up nobody. Returns true when all are done, false when SIGINT or SIGTERM came:
/// then the tasks under way are finished and the others left, as they are when a task throws or a worker
/// dies. What a task threw is thrown here, an InputError as InputError, anything else as std::runtime_error.
/// Not to be called where other threads run: fork() leaves them behind.
bool run_in_workers(int jobs, std::size_t count, const Task& task, const Progress& progress);

}  // namespace tanglebin
