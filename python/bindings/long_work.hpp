#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "bindings.hpp"
#include "tanglebin/dataset/run_observer.hpp"

namespace tanglebin::python {

/// A Python function to call with what is done so far, and with all there is to do; or None.
using Progress = std::optional<py::function>;

/// Reports the progress of work that goes on without the GIL, at most twenty times a second, and ends it by
/// an exception if the function raises one or a signal's handler does: KeyboardInterrupt after Ctrl-C.
class Reporter {
public:
  explicit Reporter(const Progress& progress) : progress_(progress) {}

  void report(double done, double total);

private:
  using Clock = std::chrono::steady_clock;
  const Progress& progress_;
  Clock::time_point next_ = Clock::now();
};

/// A function for work without progress to call now and then, which takes Ctrl-C as Reporter does.
std::function<void()> ctrl_c_taker();

/// Reports the cases of a run over a dataset that are done or given up. Both arguments must outlive the
/// result.
RunObserver observer_of(const Progress& progress);

/// After a run over a dataset, which keeps signals to itself: passes on the one that stopped it. After
/// SIGINT, this throws KeyboardInterrupt.
void pass_on_signal();

/// The turn of a simulation: the solver has one random generator per process, so there is one at a time. Made
/// without the GIL. Waits for those of other threads, and takes Ctrl-C meanwhile as Reporter does. Throws
/// std::runtime_error in the progress function of a simulation, which would wait for itself.
class SimulationTurn {
public:
  SimulationTurn();
  ~SimulationTurn();
  SimulationTurn(const SimulationTurn&) = delete;
  SimulationTurn& operator=(const SimulationTurn&) = delete;
};

}  // namespace tanglebin::python
