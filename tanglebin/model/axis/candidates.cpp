#include "tanglebin/model/axis/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "tanglebin/base/median.hpp"
#include "tanglebin/geometry/axis_parts.hpp"
#include "tanglebin/geometry/bin.hpp"
#include "tanglebin/geometry/capsule.hpp"
#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/links/beyond_ends.hpp"
#include "tanglebin/model/axis/tube_fit.hpp"

namespace tanglebin {
namespace {

// `usual` is points_on_a_radius() of the fragments.
bool is_false_speck(const AxisSteps& steps, const std::vector<std::size_t>& members, double usual,
                    const LinkSettings& settings) {
  // Points of a piece that is so long, in radii.
  constexpr double nothing = 0.5;
  constexpr double ball = 2;
  const double seen = static_cast<double>(number_of_points(steps.fragments, members)) / usual;
  if (seen < nothing) return true;
  if (seen > ball) return false;
  double length = 0;
  double hidden = 0;
  for (const std::size_t member : members) {
    length += steps.fragments[member].length;
    for (const FragmentEnd& end : steps.fragments[member].ends) hidden += end.hidden;
  }
  for (const std::size_t i : steps.chosen) {
    if (std::ranges::binary_search(members, steps.links[i].fragment)) length += steps.links[i].gap;
  }
  return unseen_length(length, hidden, steps.kind, settings) > 0;
}

// A tube with a round end that is seen from its front looks like a ball, too, but then its length must be
// known to say so.
bool is_ball(const Tube& tube, const TubeKind& kind) {
  return (tube.flat_ends || kind.length_min == 0) && total_length(tube) <= tube.radius;
}

// The surface is a tube's, as far as one tube can tell. On two sides of a box, the distances from the axis
// go with twice the angle; on a wall that is seen from its edge, nothing faces the sensor.
bool looks_like_a_tube(const TubeSurface& surface, const Support& support) {
  constexpr double ovality_max = 0.3;
  constexpr double facing_min = 0.3;
  if (surface.ovality > ovality_max || surface.facing < facing_min) return false;
  const bool is_support_known = support.shape != Support::Shape::nothing;
  if (!surface.roundness) return is_support_known;
  constexpr double least = 0.6;
  constexpr double most = 1.6;
  // Floors and walls that are not known as such show a little roundness, too: noise.
  const double of_a_tube = is_support_known ? surface.roundness_of_a_tube : 1;
  return *surface.roundness >= least * of_a_tube && *surface.roundness <= most;
}

// What is measured of the tube that the point in the middle is on.
template <typename Measure>
double usual(const CandidatesByKind& of_kinds, const Measure& measure) {
  std::vector<std::pair<double, std::size_t>> measured;
  for (const std::vector<TubeCandidate>& candidates : of_kinds) {
    for (const TubeCandidate& candidate : candidates)
      measured.emplace_back(measure(candidate), candidate.points);
  }
  return weighted_median(std::move(measured));
}

// By how much its points scatter, m.
double scatter(const TubeCandidate& candidate) {
  return candidate.surface->scatter;
}

// A fitted line that is not quite right scatters, too, however exact the scanner.
bool scatters_as_usual(const TubeCandidate& candidate, double usual) {
  constexpr double of_fit = 0.03;  // radii
  constexpr double factor_max = 2;
  return scatter(candidate) <= std::max(factor_max * usual, of_fit * candidate.tube.radius);
}

// Points per area of the tube, 1/m².
double density(const TubeCandidate& candidate) {
  return static_cast<double>(candidate.points) / (total_length(candidate.tube) * candidate.tube.radius);
}

// What is left of the border of a flat surface is narrow, and not round.
bool is_sliver(const TubeCandidate& candidate, double usual) {
  constexpr double least = 0.4;
  return !candidate.surface->roundness && density(candidate) < least * usual;
}

// Whether the axis of a tube that is here would be in the top of a wall.
bool is_in_rim(const Support& support, double radius, const Eigen::Vector3d& place) {
  const Bin& bin = support.bin;
  const double reach = support.margin + radius;
  const bool is_in_wall =
      is_over_floor(bin, place, -(bin.wall + reach)) && !is_over_floor(bin, place, radius / 2);
  return is_in_wall && place.z() > bin.height - reach && place.z() < bin.height + support.margin;
}

// A tube that lies on the rim is above it, and one in the bin beside it.
bool lies_along_rim(const Tube& tube, const Support& support) {
  if (support.shape != Support::Shape::bin) return false;
  constexpr double most = 0.8;  // of its length
  double inside = 0;
  for (const Capsule& piece : capsules(tube)) {
    for (const AxisPart& part : axis_parts(piece, tube.radius)) {
      if (is_in_rim(support, tube.radius, part.middle)) inside += part.length;
    }
  }
  return inside > most * total_length(tube);
}

// Moves what is none to the end of `odd`.
void take_unless(CandidatesByKind& of_kinds, CandidatesByKind& odd, const auto& is_tube) {
  for (std::size_t kind = 0; kind < of_kinds.size(); ++kind) {
    std::vector<TubeCandidate>& candidates = of_kinds[kind];
    const auto rest = std::stable_partition(candidates.begin(), candidates.end(), is_tube);
    std::move(rest, candidates.end(), std::back_inserter(odd[kind]));
    candidates.erase(rest, candidates.end());
  }
}

/// How the radii that the tubes of a scan show compare with their known ones.
struct UsualRatio {
  double middle;     ///< of what is seen, over what is known
  double deviation;  ///< standard deviation of that, from tube to tube
};

// Of the tube that the point in the middle is on. 0 if no tube shows a radius.
UsualRatio usual_ratio(const CandidatesByKind& of_kinds) {
  std::vector<std::pair<double, std::size_t>> ratios;
  for (const std::vector<TubeCandidate>& candidates : of_kinds) {
    for (const TubeCandidate& candidate : candidates) {
      if (!candidate.seen.empty())
        ratios.emplace_back(candidate.seen.front().radius / candidate.tube.radius, candidate.points);
    }
  }
  const double middle = weighted_median(ratios);
  for (auto& [ratio, points] : ratios) ratio = std::abs(ratio - middle);
  return {middle, deviation_of_median * weighted_median(std::move(ratios))};
}

// Farther from what tubes of the known radius show than the errors of the scanner explain.
bool is_other_radius(const SeenRadius& seen, double known, const UsualRatio& usual) {
  constexpr std::size_t pieces_min = 8;
  constexpr double tolerance = 0.2;
  constexpr double errors = 4;
  const double error = std::hypot(seen.error, usual.deviation * known);
  return seen.pieces >= pieces_min &&
         std::abs(seen.radius - usual.middle * known) > std::max(tolerance * known, errors * error);
}

// m, the first that is none of the kinds', if one is.
std::optional<double> foreign_radius(const std::vector<SeenRadius>& radii, const std::vector<TubeKind>& kinds,
                                     const UsualRatio& usual) {
  const auto foreign = std::ranges::find_if(radii, [&](const SeenRadius& seen) {
    return std::ranges::all_of(
        kinds, [&](const TubeKind& kind) { return is_other_radius(seen, kind.radius, usual); });
  });
  if (foreign == radii.end()) return std::nullopt;
  return foreign->radius;
}

// Noise on a floor is round, too, here and there.
void keep_sure_radii(CandidatesByKind& of_kinds) {
  constexpr double error_max = 0.05;  // radii
  for (std::vector<TubeCandidate>& candidates : of_kinds) {
    for (TubeCandidate& candidate : candidates)
      std::erase_if(candidate.seen,
                    [](const SeenRadius& seen) { return seen.error > error_max * seen.radius; });
  }
}

}  // namespace

std::vector<TubeCandidate> fit_candidates(const AxisSteps& steps, const std::vector<Eigen::Vector3f>& points,
                                          const KnownScene& known, const AxisSettings& settings) {
  const double usual = points_on_a_radius(steps.fragments, steps.kind.radius);
  std::vector<TubeCandidate> candidates;
  for (const std::vector<std::size_t>& members : steps.tubes) {
    if (is_false_speck(steps, members, usual, settings.link)) continue;
    Tube tube =
        fit_tube(steps.fragments, members, steps.links, steps.chosen, points, steps.kind, settings.fit);
    if (is_ball(tube, steps.kind)) continue;
    std::optional<TubeSurface> surface;
    if (!holds_only_tubes(known.support))
      surface = surface_of(tube, steps.fragments, members, points, steps.votes, known.camera);
    std::vector<SeenRadius> seen =
        seen_radii(tube, steps.fragments, members, points, known.camera.pose.translation());
    candidates.push_back(
        {members, number_of_points(steps.fragments, members), std::move(tube), surface, std::move(seen)});
  }
  return candidates;
}

CandidatesByKind take_what_is_no_tube(CandidatesByKind& of_kinds, const Support& support) {
  CandidatesByKind odd(of_kinds.size());
  if (holds_only_tubes(support)) return odd;
  for (std::vector<TubeCandidate>& candidates : of_kinds) {
    std::erase_if(candidates,
                  [&](const TubeCandidate& candidate) { return lies_along_rim(candidate.tube, support); });
  }
  take_unless(of_kinds, odd,
              [&](const TubeCandidate& candidate) { return looks_like_a_tube(*candidate.surface, support); });
  take_unless(of_kinds, odd, [usual = usual(of_kinds, density)](const TubeCandidate& candidate) {
    return !is_sliver(candidate, usual);
  });
  take_unless(of_kinds, odd, [usual = usual(of_kinds, scatter)](const TubeCandidate& candidate) {
    return scatters_as_usual(candidate, usual);
  });
  return odd;
}

std::vector<std::vector<ForeignTube>> take_foreign(CandidatesByKind& of_kinds, CandidatesByKind odd,
                                                   const std::vector<TubeKind>& kinds) {
  std::vector<std::vector<ForeignTube>> foreign(of_kinds.size());
  constexpr double tolerance = 0.1;
  const UsualRatio usual = usual_ratio(of_kinds);
  if (std::abs(usual.middle - 1) > tolerance) return foreign;
  keep_sure_radii(odd);
  for (std::size_t kind = 0; kind < of_kinds.size(); ++kind) {
    for (std::vector<TubeCandidate>* candidates : {&of_kinds[kind], &odd[kind]}) {
      std::vector<TubeCandidate> rest;
      for (TubeCandidate& candidate : *candidates) {
        if (const std::optional<double> radius = foreign_radius(candidate.seen, kinds, usual))
          foreign[kind].push_back({std::move(candidate), *radius});
        else
          rest.push_back(std::move(candidate));
      }
      *candidates = std::move(rest);
    }
  }
  return foreign;
}

}  // namespace tanglebin
