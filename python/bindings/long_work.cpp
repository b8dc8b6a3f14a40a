#include "long_work.hpp"

#include <csignal>

#include "tanglebin/runs/workers.hpp"

namespace tanglebin::python {
namespace {

void take_signals() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace

void Reporter::report(double done, double total) {
  constexpr std::chrono::milliseconds interval{50};
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + interval;
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

std::mutex& simulation() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace tanglebin::python
