#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tanglebin/runs/workers.hpp"

namespace tanglebin {

/// What a program may use up. It and all that it has started are killed if it takes more.
struct ProcessLimits {
  TimeLimit time = no_limit;              ///< wall clock
  std::optional<std::uint64_t> memory{};  ///< bytes of address space, of each of its processes
  std::optional<std::uint64_t> disk{};    ///< bytes, of each file and of its working directory in all
};

/// A program to run.
struct Process {
  std::vector<std::string> command;        ///< the program, found in PATH, and its arguments
  std::string input{};                     ///< its standard input
  std::vector<std::string> environment{};  ///< all of it, each "NAME=value"
  std::filesystem::path directory = ".";   ///< its working directory
  ProcessLimits limits{};
  std::size_t output_max = static_cast<std::size_t>(-1);  ///< bytes to keep of its output and of its error
};

/// How a program came to its end.
enum class ProcessEnd {
  exited,
  killed,     ///< by a signal that was not sent here
  too_slow,   ///< beyond ProcessLimits::time
  too_large,  ///< beyond ProcessLimits::disk
};

/// What came of a program.
struct ProcessResult {
  ProcessEnd end = ProcessEnd::exited;
  int status = 0;   ///< its exit status, or the signal that killed it
  std::string out;  ///< the last Process::output_max bytes of its standard output …
  std::string err;  ///< … and of its standard error
};

/// Runs a program without a shell, and waits for its end. Nothing that it has started is left running: not
/// when it ends, nor when the calling process does, even if by SIGKILL. Throws std::system_error if it cannot
/// be started, with std::errc::no_such_file_or_directory if it is not installed. Do not call it while other
/// threads run: fork() does not copy them.
ProcessResult run_process(const Process& process);

}  // namespace tanglebin
