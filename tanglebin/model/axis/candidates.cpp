#include "tanglebin/model/axis/candidates.hpp"

#include <algorithm>
#include <utility>

#include "tanglebin/model/axis/fragments/fragments.hpp"
#include "tanglebin/model/axis/links/beyond_ends.hpp"
#include "tanglebin/model/axis/tube_fit.hpp"

namespace tanglebin {
namespace {

std::size_t points_of(const AxisSteps& steps, const std::vector<std::size_t>& members) {
  std::size_t points = 0;
  for (const std::size_t member : members) points += steps.fragments[member].points.size();
  return points;
}

bool is_false_speck(const AxisSteps& steps, const std::vector<std::size_t>& members, const TubeKind& kind,
                    const LinkSettings& settings) {
  // Points of a piece that is so long, in radii.
  constexpr double nothing = 0.5;
  constexpr double ball = 2;
  const double seen =
      static_cast<double>(points_of(steps, members)) / points_on_a_radius(steps.fragments, kind.radius);
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
  return unseen_length(length, hidden, kind, settings) > 0;
}

// The surface is a tube's, as far as one tube can tell. On two sides of a box, the distances from the axis
// go with twice the angle; on a wall that is seen from its edge, nothing faces the sensor.
bool looks_like_a_tube(const TubeSurface& surface, const Support& support) {
  constexpr double ovality_max = 0.3;
  constexpr double facing_min = 0.3;
  if (surface.ovality > ovality_max || surface.facing < facing_min) return false;
  if (!surface.roundness) return support.shape == Support::Shape::plane;
  constexpr double least = 0.6;
  constexpr double most = 1.6;
  return *surface.roundness >= least && *surface.roundness <= most;
}

// m, of the tube that the point in the middle is on: by how much points scatter about a tube here.
double usual_scatter(const std::vector<std::vector<Candidate>>& of_kinds) {
  std::vector<std::pair<double, std::size_t>> scatters;
  std::size_t points = 0;
  for (const std::vector<Candidate>& candidates : of_kinds) {
    for (const Candidate& candidate : candidates) {
      scatters.emplace_back(candidate.surface.scatter, candidate.points);
      points += candidate.points;
    }
  }
  std::ranges::sort(scatters);
  std::size_t sum = 0;
  for (const auto& [scatter, count] : scatters) {
    sum += count;
    if (2 * sum >= points) return scatter;
  }
  return 0;
}

bool scatters_as_usual(const Candidate& candidate, double usual) {
  constexpr double exact = 0.01;  // radii
  constexpr double factor_max = 2;
  return candidate.surface.scatter <= std::max(factor_max * usual, exact * candidate.tube.radius);
}

void drop_unless(std::vector<std::vector<Candidate>>& of_kinds, const auto& is_tube) {
  for (std::vector<Candidate>& candidates : of_kinds)
    std::erase_if(candidates, [&](const Candidate& candidate) { return !is_tube(candidate); });
}

}  // namespace

std::vector<Candidate> fit_candidates(const AxisSteps& steps, const std::vector<Eigen::Vector3f>& points,
                                      const TubeKind& kind, const Camera& camera,
                                      const AxisSettings& settings) {
  std::vector<Candidate> candidates;
  for (const std::vector<std::size_t>& members : steps.tubes) {
    if (is_false_speck(steps, members, kind, settings.link)) continue;
    Tube tube = fit_tube(steps.fragments, members, steps.links, steps.chosen, points, kind, settings.fit);
    const TubeSurface surface = surface_of(tube, steps.fragments, members, points, steps.votes, camera);
    candidates.push_back({members, points_of(steps, members), std::move(tube), surface});
  }
  return candidates;
}

void drop_what_is_no_tube(std::vector<std::vector<Candidate>>& of_kinds, const Support& support) {
  drop_unless(of_kinds, [](const Candidate& candidate) {
    return !candidate.tube.flat_ends || total_length(candidate.tube) > candidate.tube.radius;
  });
  if (support.shape == Support::Shape::bin) return;
  drop_unless(of_kinds,
              [&](const Candidate& candidate) { return looks_like_a_tube(candidate.surface, support); });
  const double usual = usual_scatter(of_kinds);
  drop_unless(of_kinds, [&](const Candidate& candidate) { return scatters_as_usual(candidate, usual); });
}

}  // namespace tanglebin
