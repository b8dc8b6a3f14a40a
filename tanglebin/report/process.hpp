#pragma once

#include <string>
#include <vector>

namespace tanglebin {

/// The output and exit status of a program.
struct ProcessResult {
  int status = 0;  ///< exit status; −1 if a signal ended it
  std::string out;
  std::string err;
};

/// Runs command[0], found in PATH, without a shell. The other elements are its arguments, `input` its
/// standard input, and LC_ALL=C.UTF-8 its whole environment. Throws std::system_error if it cannot be
/// started, with std::errc::no_such_file_or_directory if it is not installed.
ProcessResult run_process(const std::vector<std::string>& command, const std::string& input);

}  // namespace tanglebin
