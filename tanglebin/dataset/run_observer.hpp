#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tanglebin/recipe/case_id.hpp"

namespace tanglebin {

/// The progress of a run over many cases.
struct RunProgress {
  std::size_t wanted = 0;    ///< cases asked for
  std::size_t found = 0;     ///< of these, there before the run
  std::size_t made = 0;      ///< of these, made by it
  std::size_t failed = 0;    ///< of these, given up
  std::size_t rejected = 0;  ///< attempts that gave no valid scene, over the cases made
};

/// The end of one case.
struct CaseEvent {
  CaseId id;
  double seconds = 0.0;      ///< wall clock
  std::size_t rejected = 0;  ///< attempts that gave no valid scene
  std::string failure;       ///< why it is given up; empty where it is made
};

/// Functions to call, in the calling process, as a run over many cases goes on.
struct RunObserver {
  std::function<void(const std::vector<CaseId>&)> begun = [](const auto&) {};  ///< once, with the cases to do
  std::function<void(const RunProgress&)> progress = [](const auto&) {};       ///< a few times a second
  std::function<void(const CaseEvent&, const RunProgress&)> ended = [](const auto&, const auto&) {};
  std::function<void()> stopping = [] {};  ///< after the first SIGINT or SIGTERM
};

}  // namespace tanglebin
