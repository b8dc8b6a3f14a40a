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

std::vector<std::size_t> numbers_from(std::size_t first, std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

// Scenes with a loss, but not one that nothing can help.
std::vector<std::size_t> typical_scenes(const std::vector<double>& scores, double mean) {
  std::vector<std::size_t> order = numbers_from(0, scores.size());
  const auto distance = [&](std::size_t scene) {
    return std::pair(scores[scene] >= mean, std::abs(scores[scene] - mean));
  };
  std::ranges::stable_sort(order, {}, distance);
  order.resize(std::min(scenes_of_glance, order.size()));
  return order;
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
      scores_(scorer_(first, numbers_from(0, scenes))),
      score_(mean_of(scores_)),
      typical_(typical_scenes(scores_, score_)) {}

double Race::advantage(const Parameters& candidate, Look look) const {
  const std::size_t count = std::min(scenes_of_heat, scores_.size());
  const std::vector<std::size_t> scenes = look == Look::glance ? typical_ : numbers_from(0, count);
  return mean_of(gains(scorer_(candidate, scenes), scenes));
}

std::vector<double> Race::gains(const std::vector<double>& scores,
                                const std::vector<std::size_t>& scenes) const {
  std::vector<double> gains = scores;
  for (std::size_t i = 0; i < scenes.size(); ++i) gains[i] -= scores_[scenes[i]];
  return gains;
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
  while (outcome.scores.size() < scores_.size() && !outcome.is_dropped) {
    const std::size_t done = outcome.scores.size();
    const std::vector<double> more =
        scorer_(candidate, numbers_from(done, std::min(scenes_of_heat, scores_.size() - done)));
    outcome.scores.insert(outcome.scores.end(), more.begin(), more.end());
    const std::vector<double> so_far = gains(outcome.scores, numbers_from(0, outcome.scores.size()));
    outcome.mean = score_ + mean_of(so_far);
    outcome.is_dropped = so_far.size() < scores_.size() && is_worse(so_far);
  }
  return outcome;
}

void Race::take(const Parameters& candidate, Outcome outcome) {
  best_ = candidate;
  scores_ = std::move(outcome.scores);
  score_ = outcome.mean;
}

}  // namespace tanglebin
