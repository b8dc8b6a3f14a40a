#pragma once

#include "tanglebin/runs/workers.hpp"

// What the program's exit status says (docs/formats.md).
namespace tanglebin::cli {

inline constexpr int exit_internal_error = 1;  ///< a bug
inline constexpr int exit_bad_input = 2;       ///< a file, a recipe or the value of an option is wrong
inline constexpr int exit_cases_failed = 3;    ///< the command ran, but cases failed
inline constexpr int exit_faults = 4;          ///< `verify` found faults
inline constexpr int exit_refused = 5;         ///< the system refused: disk full, out of memory, …
inline constexpr int exit_nothing_found = 6;   ///< `model`: the scan does not fit its scene, or shows no tube
inline constexpr int exit_below = 7;           ///< `compare`: worse than --fail-below allows
inline constexpr int exit_usage = 64;          ///< wrong usage: EX_USAGE of sysexits.h

/// Of a run that a signal interrupted, as a shell reports it: 130 for SIGINT, 143 for SIGTERM.
inline int exit_interrupted() {
  constexpr int base_of_signals = 128;
  return base_of_signals + interrupting_signal();
}

}  // namespace tanglebin::cli
