#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "tanglebin/experiment/modelled.hpp"

namespace tanglebin {

/// A model with more labels is not shown: scenes in 3D hold them in 16 bits, beside those of the truth.
inline constexpr std::size_t most_labels_to_show = 30'000;

/// The models behind an experiment's results, to show what was found. Built-in methods model a case once
/// more, which gives the same. A command's models are read from where `experiment --keep` kept them; if they
/// were not kept, it runs once more for each case, however often the case is asked for.
class ModelAgain {
public:
  /// A command's files are in a directory of their own in `results`, for the lifetime of this object. Calls
  /// `at_run` before each run; what it throws ends the work.
  ModelAgain(
      std::filesystem::path results, const Dataset& dataset, const ExperimentSettings& settings,
      std::function<void()> at_run = [] {});
  ~ModelAgain();
  ModelAgain(const ModelAgain&) = delete;
  ModelAgain& operator=(const ModelAgain&) = delete;

  /// The model of a case at the ratio to show; none if a command fails this time, or if it has too many
  /// labels. Throws InputError as model_by() does for a method that is built in.
  std::optional<Model> operator()(const Entry& entry, const SeenCase& seen, const CaseData& data);

  /// Of the models asked for so far, those with too many labels: the entry's name and the case.
  const std::set<std::pair<std::string, SeenCase>>& left_out() const { return left_out_; }

private:
  std::optional<Model> known_or_new(const Entry& entry, const SeenCase& seen, const CaseData& data);
  std::optional<Model> model(const Entry& entry, const SeenCase& seen, const CaseData& data) const;

  std::filesystem::path results_;
  const Dataset& dataset_;
  const ExperimentSettings& settings_;
  std::function<void()> at_run_;
  std::filesystem::path scratch_;
  std::map<std::pair<std::string, SeenCase>, std::optional<Model>> of_commands_;
  std::set<std::pair<std::string, SeenCase>> left_out_;
};

}  // namespace tanglebin
