#include "long_work.hpp"

#include <csignal>
#include <mutex>
#include <stdexcept>

#include "tanglebin/runs/workers.hpp"

namespace tanglebin::python {
namespace {

constexpr std::chrono::milliseconds between_signals{50};

std::timed_mutex simulation;
thread_local bool is_simulating = false;

void take_signals() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace

void Reporter::report(double done, double total) {
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + between_signals;
  const py::gil_scoped_acquire acquired;
  take_signals();
  if (progress_) (*progress_)(done, total);
}

std::function<void()> ctrl_c_taker() {
  static const Progress none;
  return [reporter = Reporter(none)]() mutable { reporter.report(0, 0); };
}

RunObserver observer_of(const Progress& progress) {
  RunObserver observer;
  observer.progress = [&progress](const RunProgress& run) {
    const py::gil_scoped_acquire acquired;
    if (progress) (*progress)(run.found + run.made + run.failed, run.wanted);
  };
  return observer;
}

void pass_on_signal() {
  std::raise(interrupting_signal());
  take_signals();
}

SimulationTurn::SimulationTurn() {
  if (is_simulating)
    throw std::runtime_error("a simulation's progress function cannot start another simulation");
  while (!simulation.try_lock_for(between_signals)) {
    const py::gil_scoped_acquire acquired;
    take_signals();
  }
  is_simulating = true;
}

SimulationTurn::~SimulationTurn() {
  is_simulating = false;
  simulation.unlock();
}

}  // namespace tanglebin::python
