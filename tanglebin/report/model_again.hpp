#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "tanglebin/experiment/modelled.hpp"

namespace tanglebin {

/// Models runs of an experiment once more, to show what was found.
class ModelAgain {
public:
  /// A command's files are in a directory of their own in `results`, for the lifetime of this object. Calls
  /// `at_run` before each run.
  ModelAgain(const std::filesystem::path& results, const Dataset& dataset, const ExperimentSettings& settings,
             const std::function<void()>& at_run);
  ~ModelAgain();
  ModelAgain(const ModelAgain&) = delete;
  ModelAgain& operator=(const ModelAgain&) = delete;

  /// The model of a case at the ratio to show; none if a command fails this time. Throws InputError as
  /// model_by() does for a method that is built in.
  std::optional<Model> operator()(const Entry& entry, const SeenCase& seen, const CaseData& data) const;

private:
  const Dataset& dataset_;
  const ExperimentSettings& settings_;
  const std::function<void()>& at_run_;
  std::filesystem::path scratch_;
};

}  // namespace tanglebin
