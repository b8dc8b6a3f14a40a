#include "tanglebin/calibrate/race.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace tanglebin {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double standard_error(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  const auto count = static_cast<double>(values.size());
  return std::sqrt(sum / (count - 1) / count);
}

// Of the first scenes, as many as there are scores.
std::vector<double> differences_of(const std::vector<double>& scores, const std::vector<double>& of_best) {
  std::vector<double> differences;
  differences.reserve(scores.size());
  for (std::size_t i = 0; i < scores.size(); ++i) differences.push_back(scores[i] - of_best[i]);
  return differences;
}

// Even two standard errors above what it seems.
bool is_worse(const std::vector<double>& differences) {
  constexpr double errors = 2;
  return differences.size() > 1 && mean_of(differences) + errors * standard_error(differences) < 0;
}

}  // namespace

Race::Race(Scorer scorer, std::size_t scenes, const Parameters& first)
    : scorer_(std::move(scorer)),
      best_(first),
      scores_(scorer_(first, 0, scenes)),
      score_(mean_of(scores_)) {}

double Race::glance(const Parameters& candidate) const {
  const std::size_t count = std::min(scenes_of_heat, scores_.size());
  return mean_of(differences_of(scorer_(candidate, 0, count), scores_));
}

double Race::run(const Parameters& candidate) {
  Outcome outcome = compete(candidate);
  const double mean = outcome.mean;
  if (!outcome.is_dropped && mean > score_) take(candidate, std::move(outcome));
  return mean;
}

bool Race::take_if_as_good(const Parameters& candidate) {
  Outcome outcome = compete(candidate);
  const bool is_as_good = !outcome.is_dropped && outcome.mean >= score_;
  if (is_as_good) take(candidate, std::move(outcome));
  return is_as_good;
}

Race::Outcome Race::compete(const Parameters& candidate) const {
  Outcome outcome{};
  while (outcome.scores.size() < scores_.size()) {
    const std::size_t first = outcome.scores.size();
    const std::vector<double> more =
        scorer_(candidate, first, std::min(scenes_of_heat, scores_.size() - first));
    outcome.scores.insert(outcome.scores.end(), more.begin(), more.end());
    const std::vector<double> differences = differences_of(outcome.scores, scores_);
    outcome.mean = score_ + mean_of(differences);
    outcome.is_dropped = outcome.scores.size() < scores_.size() && is_worse(differences);
    if (outcome.is_dropped) break;
  }
  return outcome;
}

void Race::take(const Parameters& candidate, Outcome outcome) {
  best_ = candidate;
  scores_ = std::move(outcome.scores);
  score_ = outcome.mean;
}

}  // namespace tanglebin
