#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/model/scene/model.hpp"

// Internal to the room.
namespace tanglebin {

/// Records each step and its duration as it ends, then calls `at_step`.
class StepClock {
public:
  StepClock(std::vector<Step>& steps, const std::function<void()>& at_step)
      : steps_(steps), at_step_(at_step) {}

  void end_step(std::string name, std::size_t count, std::string of) {
    const auto now = std::chrono::steady_clock::now();
    steps_.push_back(
        {std::move(name), std::chrono::duration<double>(now - start_).count(), count, std::move(of)});
    start_ = now;
    at_step_();
  }

private:
  std::vector<Step>& steps_;
  const std::function<void()>& at_step_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace tanglebin
