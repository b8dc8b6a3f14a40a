#pragma once

namespace tanglebin {

/// While one lives, SIGINT and SIGTERM are kept for run_in_workers() (workers.hpp). Where it is called many
/// times, this keeps a signal that arrives between two calls for the next.
class InterruptGuard {
public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

}  // namespace tanglebin
