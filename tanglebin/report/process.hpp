#pragma once

#include <string>
#include <vector>

namespace tanglebin {

/// What a program wrote, and how it ended.
struct ProcessResult {
  int status = 0;  ///< exit status; −1 where a signal ended it
  std::string out;
  std::string err;
};

/// Runs command[0], looked for in PATH, without a shell, with the other elements as its arguments, `input` on
/// its standard input and no environment but LC_ALL=C.UTF-8. Throws std::system_error where it cannot be
/// started: std::errc::no_such_file_or_directory where it is not installed.
ProcessResult run_process(const std::vector<std::string>& command, const std::string& input);

}  // namespace tanglebin
