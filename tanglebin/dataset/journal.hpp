#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "tanglebin/dataset/workers.hpp"

namespace tanglebin {

/// The journal of a directory: a line for each task that is done and not yet in the directory's other files.
/// A run that is cut off leaves it behind; the next one reads it.
std::filesystem::path journal_of(const std::filesystem::path& directory);

/// Calls `take` with every line of the file that has its end, and the line's number: a last line that was cut
/// off is passed over. A file that is not there has no lines.
void for_each_whole_line(const std::filesystem::path& file,
                         const std::function<void(const std::string&, std::size_t)>& take);

/// A task whose result is a line for the journal.
using JournaledTask = std::function<std::string(std::size_t task)>;

/// run_in_workers(), in which a task is done when its line is in the directory's journal and on the disk.
/// Whatever ends the run, `finish` is called at its end, to move the journal's lines to where they belong.
void run_with_journal(const std::filesystem::path& directory, int jobs, std::size_t count,
                      const JournaledTask& task, const Progress& progress,
                      const std::function<void()>& finish);

}  // namespace tanglebin
