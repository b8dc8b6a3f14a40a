#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace tanglebin {

/// Does one task and returns what there is to say of it. Runs in a worker process.
using Task = std::function<std::string(std::size_t task)>;

/// Takes what a finished task returned. Runs in the calling process, in the order of completion.
using TaskDone = std::function<void(std::size_t task, const std::string& result)>;

/// Runs tasks 0 … count − 1 in `jobs` forked processes. A worker gets its next task when it is done with the last one, so
/// a slow task holds up nobody. Returns true when all are done, false when SIGINT or SIGTERM came: then the tasks under way are
/// finished and the rest left. What a task throws ends the run likewise, and is thrown here (InputError as InputError, anything
/// else, and the death of a worker, as std::runtime_error).
bool run_in_workers(int jobs, std::size_t count, const Task& task, const TaskDone& done);

}  // namespace tanglebin
