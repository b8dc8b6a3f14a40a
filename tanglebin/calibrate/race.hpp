#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tanglebin {

/// Values of parameters by name, of those that are not at their defaults.
using Parameters = std::map<std::string, double>;

/// The scores, 0 to 1, of parameters on some of the scenes, which are numbered from 0.
using Scorer =
    std::function<std::vector<double>(const Parameters& parameters, const std::vector<std::size_t>& scenes)>;

/// Scenes of a glance at a candidate, and those that it is scored on before it is compared with the best.
inline constexpr std::size_t scenes_of_glance = 2;
inline constexpr std::size_t scenes_of_heat = 10;

/// How closely to look at a candidate that is not in the race.
enum class Look {
  glance,  ///< at two typical scenes: of those that score below the best's mean at first, the nearest to it
  heat,    ///< at the scenes of a first heat
};

/// Compares candidates with the best so far on the same scenes, and drops those that are worse after a few of
/// them, as in Maron and Moore 1997, "The racing algorithm". What the scorer throws leaves the best as it is.
class Race {
public:
  /// Scores the first candidate on all scenes.
  Race(Scorer scorer, std::size_t scenes, const Parameters& first);

  const Parameters& best() const { return best_; }

  /// The mean of the best over all scenes.
  double score() const { return score_; }

  /// How much better a candidate is than the best on a few scenes; negative if it is worse.
  double advantage(const Parameters& candidate, Look look) const;

  /// The mean score of a candidate, which becomes the best if it is better on all scenes. If it is dropped
  /// before, its mean is estimated from its differences up to then.
  double run(const Parameters& candidate);

  /// Takes a candidate as the best if it is at least as good. Returns whether it is.
  bool take_if_as_good(const Parameters& candidate);

private:
  /// How a candidate came out.
  struct Outcome {
    std::vector<double> scores;
    double mean;
    bool is_dropped;
  };
  std::vector<double> gains(const std::vector<double>& scores, const std::vector<std::size_t>& scenes) const;
  Outcome compete(const Parameters& candidate) const;
  void take(const Parameters& candidate, Outcome outcome);

  Scorer scorer_;
  Parameters best_;
  std::vector<double> scores_;
  double score_;
  std::vector<std::size_t> typical_;  ///< scenes for a glance
};

}  // namespace tanglebin
