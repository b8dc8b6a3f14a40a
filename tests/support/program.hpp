#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "tests/support/temporary_directory.hpp"

namespace tanglebin::test {

/// What a run of a program came to.
struct ProgramResult {
  int status;  ///< exit status; −1 where a signal ended it
  std::string out;
  std::string err;
};

/// Runs a shell's command line; what it reads from standard input comes from `input`.
inline ProgramResult run_shell(const std::string& command, const std::string& input = {}) {
  const TemporaryDirectory directory;
  write_bytes(directory / "in", input);
  const std::string redirected = "( " + command + "\n) <" + (directory / "in").string() + " >" +
                                 (directory / "out").string() + " 2>" + (directory / "err").string();
  const int status = std::system(redirected.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytes_of(directory / "out"),
          bytes_of(directory / "err")};
}

/// Runs the program with a shell's command line after its name.
inline ProgramResult run_program(const std::string& arguments, const std::string& input = {}) {
  return run_shell(std::string(TANGLEBIN_PROGRAM) + " " + arguments, input);
}

}  // namespace tanglebin::test
