#pragma once

#include <chrono>
#include <cstddef>
#include <exception>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tanglebin/calibrate/objective.hpp"
#include "tanglebin/calibrate/race.hpp"
#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/runs/journal.hpp"
#include "tanglebin/runs/workers.hpp"

namespace tanglebin {

/// How to score parameters on a scene.
struct ScoringSettings {
  Method method = Method::axis;
  Objective objective = Objective::unmixed_recall;
  double ratio = 1;                                  ///< of the downsampling
  TimeLimit scene_limit = std::chrono::seconds(60);  ///< wall clock; a scene that takes longer scores 0
  int jobs = 1;                                      ///< worker processes
};

/// Thrown when SIGINT or SIGTERM ends a calibration. What was scored until then is in the journal.
class CalibrationStopped : public std::exception {};

/// The scores of parameters on scenes of a dataset: the mean over the recipe's scanners. Whatever parameters
/// filter away, they are scored on the points that the default filter leaves. A failure, such as no tube
/// found, a crash or too long a time, scores 0. Each score is made once: it is kept in the journal.
class SceneScores {
public:
  /// `part` tells the journal's lines from those of other datasets. Dataset and journal must outlive this.
  SceneScores(std::string part, const Dataset& dataset, std::vector<CaseId> scenes,
              const ScoringSettings& settings, const Journal& journal, WorkersObserver observer);

  std::size_t scenes() const { return scenes_.size(); }

  /// As a Scorer. Throws CalibrationStopped, InputError if a scene cannot be read, SystemError if the journal
  /// cannot be written.
  std::vector<double> scores(const Parameters& parameters, const std::vector<std::size_t>& scenes);

  /// How many different scores it was asked for; how many of these are there, and were made here.
  std::size_t asked() const { return asked_.size(); }
  std::size_t answered() const { return asked_.size() - awaited_; }
  std::size_t made() const { return made_; }

private:
  using Key = std::pair<Parameters, std::string>;  // with the scene's name

  void read_journal();
  void make(const Parameters& parameters, const std::vector<CaseId>& scenes);
  void keep(const Parameters& parameters, const std::map<std::string, double>& scores);

  std::string part_;
  const Dataset& dataset_;
  std::vector<CaseId> scenes_;
  ScoringSettings settings_;
  const Journal& journal_;
  WorkersObserver observer_;
  std::map<Key, double> known_{};
  std::set<Key> asked_{};
  std::size_t awaited_ = 0;
  std::size_t made_ = 0;
};

}  // namespace tanglebin
