#include "tanglebin/model/axis/axis_method.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "tanglebin/base/constants.hpp"
#include "tanglebin/base/picked.hpp"
#include "tanglebin/geometry/labels.hpp"
#include "tanglebin/model/axis/candidates.hpp"
#include "tanglebin/model/axis/fragments/kinds.hpp"
#include "tanglebin/model/axis/fragments/ramps.hpp"
#include "tanglebin/model/axis/links/beyond_ends.hpp"
#include "tanglebin/model/axis/links/choose_links.hpp"
#include "tanglebin/model/axis/links/join_odds.hpp"
#include "tanglebin/model/axis/links/length.hpp"
#include "tanglebin/model/axis/links/mixed_fragments.hpp"
#include "tanglebin/model/axis/tries.hpp"
#include "tanglebin/model/scene/range_image.hpp"
#include "tanglebin/model/scene/step_clock.hpp"
#include "tanglebin/model/scene/weigh.hpp"

namespace tanglebin {
namespace {

using Eigen::Vector3f;

// The number of items that a step produced, over all kinds.
template <typename Count>
std::size_t total(const std::vector<AxisSteps>& kinds, Count count) {
  std::size_t sum = 0;
  for (const AxisSteps& steps : kinds) sum += count(steps);
  return sum;
}

// The space that the fragments of all kinds but one fill.
std::vector<Ball> space_of_other_kinds(const std::vector<AxisSteps>& kinds, const KnownScene& known,
                                       const AxisSteps& but) {
  std::vector<Ball> space;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (&kinds[i] == &but) continue;
    for (const Fragment& fragment : kinds[i].fragments) {
      for (const Eigen::Vector3d& node : fragment.nodes) space.push_back({node, known.kinds[i].radius});
    }
  }
  return space;
}

// What the steps say of each tube: its kind, and the odds of its joins.
std::vector<TubeEvidence> evidence_of(const AxisSteps& steps, std::size_t kind, double length_max) {
  const std::vector<TubeJoin> joins = joins_of(steps.fragments, steps.links, steps.chosen, length_max);
  std::vector<TubeEvidence> evidence;
  for (const std::vector<std::size_t>& fragments : steps.tubes) {
    evidence.push_back({.kind = kind, .joins = {}});
    for (std::size_t i = 0; i < joins.size(); ++i) {
      if (std::ranges::binary_search(fragments, steps.links[steps.chosen[i]].fragment))
        evidence.back().joins.push_back(joins[i]);
    }
  }
  return evidence;
}

Ramps ramps_in(const PointCloud& cloud, const KnownScene& known, const RampSettings& settings) {
  const auto [thinnest, thickest] = std::ranges::minmax(known.kinds, {}, &TubeKind::radius);
  return find_ramps(cloud.points, known.camera, thinnest.radius, thickest.radius, settings);
}

// The points, without those on ramps: NaN.
std::vector<Vector3f> without(const Ramps& ramps, std::vector<Vector3f> points,
                              const std::vector<std::size_t>& indices) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (ramps.points[indices[i]]) points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  return points;
}

// The points that the crop kept.
std::vector<BlendedPoint> kept(std::vector<BlendedPoint> between, const Cropped& cropped) {
  std::erase_if(between, [&](const BlendedPoint& blended) {
    return !std::ranges::binary_search(cropped.kept, blended.point);
  });
  return between;
}

// Without what keeps false votes out where a scanner makes ramps, and a few true ones.
AxisSettings for_sharp_edges(AxisSettings settings) {
  settings.vote.facing_min = 0;
  settings.fragment.weak_max = 0;
  return settings;
}

/// The points that the filter kept, and what they vote for.
struct Voting {
  std::vector<std::size_t> filtered;  ///< the points' indices in the cloud
  std::vector<Vector3f> points;       ///< m
  std::vector<AxisVotes> of_kinds;    ///< for each kind of tube
};

std::size_t number_of_votes(const Voting& voting) {
  std::size_t sum = 0;
  for (const AxisVotes& votes : voting.of_kinds) {
    sum += static_cast<std::size_t>(
        std::ranges::count_if(votes.votes, [](const Vector3f& vote) { return vote.allFinite(); }));
  }
  return sum;
}

// Where there may be anything, normals have to tell.
OtherSurfaces other_surfaces(const Voting& voting, const Support& support, std::size_t points) {
  if (holds_only_tubes(support)) return {support};
  std::vector<Vector3f> normals(points, Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  for (const AxisVotes& votes : voting.of_kinds) {
    for (std::size_t i = 0; i < voting.filtered.size(); ++i) {
      if (votes.normals[i].allFinite()) normals[voting.filtered[i]] = votes.normals[i];
    }
  }
  return {support, std::move(normals)};
}

/// What is modelled.
struct Scan {
  const PointCloud& cloud;
  const Cropped& cropped;
  const KnownScene& known;
  const OtherSurfaces& others;
  const std::vector<BlendedPoint>& blended;  ///< of those kept; none if the scanner makes no ramps
};

// Adds the candidate's tube, and claims the points that it was fitted to.
void add_tube(Model& model, std::vector<std::int32_t>& claimed, TubeCandidate candidate,
              const AxisSteps& steps) {
  const auto id = static_cast<std::int32_t>(model.tubes.size() + 1);
  model.tubes.push_back(std::move(candidate.tube));
  model.tubes.back().id = id;
  for (const std::size_t fragment : candidate.fragments) {
    for (const std::size_t point : steps.fragments[fragment].points) claimed[model.filtered[point]] = id;
  }
}

// A foreign tube keeps its points from being its neighbours'; they are on no tube.
void label(Model& model, std::vector<std::int32_t> claimed, const std::vector<AxisSteps>& kinds,
           std::vector<std::vector<ForeignTube>> foreign, const Scan& scan, const LabelSettings& settings) {
  const std::size_t known = model.tubes.size();
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    for (ForeignTube& tube : foreign[kind]) {
      add_tube(model, claimed, std::move(tube.candidate), kinds[kind]);
      model.foreign_radii.push_back(tube.radius);
    }
  }
  model.labels =
      label_points(scan.cloud, scan.cropped, std::move(claimed), model.tubes, settings, scan.others);
  model.tubes.resize(known);
  std::ranges::replace_if(
      model.labels, [&](std::int32_t label) { return label > static_cast<std::int32_t>(known); }, null_label);
}

// A point on a ramp, between two tubes or beside one, is on the tube of which it has more, whatever is
// nearest.
void label_ramps(Model& model, const Scan& scan) {
  if (scan.blended.empty()) return;
  const std::vector<std::int32_t> of_surfaces = model.labels;
  for (const auto& [point, end] : scan.blended) {
    if (of_surfaces[end] > bin_label) model.labels[point] = of_surfaces[end];
  }
  for (TubeEvidence& evidence : model.evidence) evidence.points = 0;
  for (const std::int32_t label : model.labels) {
    if (label > bin_label) ++model.evidence[static_cast<std::size_t>(label) - 1].points;
  }
}

// The lengths that were found for sure where none was known.
std::vector<EstimatedLength> estimated_lengths(const KnownScene& known, const std::vector<AxisSteps>& kinds) {
  std::vector<EstimatedLength> lengths;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (!known.kinds[i].length_is_known() && kinds[i].kind.length_min > 0)
      lengths.push_back({i, kinds[i].kind.length()});
  }
  return lengths;
}

KnownScene with_lengths(KnownScene known, const std::vector<EstimatedLength>& lengths) {
  for (const auto& [kind, length] : lengths)
    known.kinds[kind].segments[0].length = known.kinds[kind].length_min = length;
  return known;
}

// Whether a fragment can be of a tube, up to this long (m), that lies in the support, or on it: in a bin,
// where any of it is over the floor, or above the rim and not so far beyond the walls that the tube would
// fall out.
bool is_in(const Support& support, const Fragment& fragment, double length) {
  if (support.shape != Support::Shape::bin) return true;
  const double outside = support.bin.wall + length / 2;
  return std::ranges::any_of(fragment.nodes, [&](const Eigen::Vector3d& node) {
    return is_over_floor(support.bin, node) ||
           (node.z() > support.bin.height && is_over_floor(support.bin, node, -outside));
  });
}

// A tube lies in its bin for the most part. What stands beside a bin, such as a rack, says nothing of its
// tubes, nor does its rim.
std::vector<Fragment> fragments_in(const Support& support, const std::vector<Fragment>& fragments) {
  if (support.shape != Support::Shape::bin) return fragments;
  const auto is_over = [&](const Eigen::Vector3d& node) { return is_over_floor(support.bin, node); };
  std::vector<Fragment> inside;
  std::ranges::copy_if(fragments, std::back_inserter(inside), [&](const Fragment& fragment) {
    return 2 * std::ranges::count_if(fragment.nodes, is_over) > std::ssize(fragment.nodes);
  });
  return inside;
}

// Takes out the tubes, fragments and all, that have no part in the support: they are no tubes in it. One that
// hangs over the rim stays whole. Returns true if there were any.
bool drop_beside(const Support& support, AxisSteps& steps) {
  const double length = steps.kind.length();
  std::vector<bool> is_beside(steps.fragments.size());
  for (const std::vector<std::size_t>& members : steps.tubes) {
    const bool is_inside = std::ranges::any_of(
        members, [&](std::size_t member) { return is_in(support, steps.fragments[member], length); });
    for (const std::size_t member : members) is_beside[member] = !is_inside;
  }
  std::size_t number = 0;
  return std::erase_if(steps.fragments, [&](const Fragment&) { return is_beside[number++]; }) > 0;
}

// Of a kind. A heap of sixty tubes has some 500. Where there are more than this, nearly all are noise, and to
// compare each with all others would take minutes.
constexpr std::size_t pieces_max = 3000;

// The steps from votes to labels. The grid of voxels that the votes are sorted into is moved by `shift`;
// `tries` were made before, with other shifts.
AxisModel model_votes(const Voting& voting, const RangeImage& seen, const Scan& scan,
                      const AxisSettings& settings, double shift, const std::vector<AxisModel>& tries,
                      const std::function<void()>& at_step) {
  const KnownScene& known = scan.known;
  AxisModel result;
  Model& model = result.model;
  model.filtered = voting.filtered;
  for (const AxisVotes& votes : voting.of_kinds) result.kinds.emplace_back().votes = votes;
  StepClock clock(model.steps, at_step);

  for (std::size_t i = 0; i < known.kinds.size(); ++i) {
    const TubeKind& kind = known.kinds[i];
    result.kinds[i].fragments =
        find_fragments(result.kinds[i].votes, kind.radius, kind.branches(), settings.fragment, shift);
    model.pieces_left_out += keep_largest(result.kinds[i].fragments, pieces_max);
  }
  clock.end_step("fragment", total(result.kinds, [](const auto& steps) { return steps.fragments.size(); }),
                 "fragments");

  const auto join = [&](std::size_t kind) {
    AxisSteps& steps = result.kinds[kind];
    steps.links = find_links(steps.fragments, seen, steps.kind, settings.link,
                             space_of_other_kinds(result.kinds, known, steps));
    ChosenLinks chosen = choose_links(steps.fragments, steps.links, steps.kind, settings.link, seen,
                                      shapes_in(tries, kind, steps.kind));
    steps.chosen = std::move(chosen.links);
    steps.shapes = std::move(chosen.shapes);
    steps.tubes = linked_fragments(steps.fragments.size(), steps.links, steps.chosen);
  };
  for (std::size_t i = 0; i < known.kinds.size(); ++i) {
    AxisSteps& steps = result.kinds[i];
    const double radius = known.kinds[i].radius;
    look_beyond_ends(steps.fragments, radius, seen);
    steps.kind =
        with_length(known.kinds[i], fragments_in(known.support, steps.fragments), seen, settings.link);
    if (cut_too_long(steps.fragments, steps.votes, radius, length_max(steps.kind.length(), settings.link),
                     settings.fragment))
      look_beyond_ends(steps.fragments, radius, seen);
    join(i);
    if (cut_mixed(steps.fragments, steps.votes, radius, steps.shapes, settings.fragment)) {
      look_beyond_ends(steps.fragments, radius, seen);
      join(i);
    }
    while (drop_beside(known.support, steps)) join(i);
  }
  clock.end_step("join", total(result.kinds, [](const auto& steps) { return steps.tubes.size(); }), "tubes");

  CandidatesByKind candidates;
  for (const AxisSteps& steps : result.kinds)
    candidates.push_back(fit_candidates(steps, voting.points, known, settings));
  CandidatesByKind odd = take_what_is_no_tube(candidates, known.support);
  std::vector<std::vector<ForeignTube>> foreign = take_foreign(candidates, std::move(odd), known.kinds);
  std::vector<std::int32_t> claimed(scan.cloud.points.size(), null_label);
  for (std::size_t kind = 0; kind < known.kinds.size(); ++kind) {
    AxisSteps& steps = result.kinds[kind];
    steps.tubes.clear();
    for (TubeCandidate& candidate : candidates[kind]) {
      steps.tubes.push_back(candidate.fragments);
      add_tube(model, claimed, std::move(candidate), steps);
    }
    std::ranges::move(evidence_of(steps, kind, length_max(steps.kind.length(), settings.link)),
                      std::back_inserter(model.evidence));
  }
  clock.end_step("fit", model.tubes.size(), "tubes");

  label(model, std::move(claimed), result.kinds, std::move(foreign), scan, settings.label);
  clock.end_step("label",
                 static_cast<std::size_t>(std::ranges::count_if(
                     model.labels, [](std::int32_t label) { return label > bin_label; })),
                 "points");
  model.estimated_lengths = estimated_lengths(known, result.kinds);
  // Confidence was learned with each point on the nearest tube.
  weigh(model, scan.cloud, with_lengths(known, model.estimated_lengths));
  label_ramps(model, scan);
  return result;
}

void add_times(std::vector<Step>& steps, const std::vector<Step>& others) {
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i].seconds += others[i].seconds;
}

// Where voxels begin is arbitrary. But where votes are noisy, it decides what hangs together. In voxels.
constexpr std::array other_shifts = {0.5, 0.25, 0.75};

}  // namespace

AxisModel model_by_axes(const PointCloud& cloud, const KnownScene& known, double ratio, std::uint64_t seed,
                        const AxisSettings& given, const std::function<void()>& at_step) {
  std::vector<Step> steps;
  StepClock clock(steps, at_step);

  const Cropped cropped = crop(cloud, known.support, given.filter);
  Voting voting{downsample(cropped.kept, ratio, seed), {}, {}};
  voting.points = picked(cloud.points, voting.filtered);
  Ramps ramps = ramps_in(cloud, known, given.ramp);
  const bool has_ramps = ramps.blended >= given.ramp.blended_min;
  const std::vector<BlendedPoint> blended =
      has_ramps ? kept(std::move(ramps.between), cropped) : std::vector<BlendedPoint>{};
  const AxisSettings settings = has_ramps ? given : for_sharp_edges(given);
  std::vector<Vector3f> voters = has_ramps ? without(ramps, voting.points, voting.filtered) : voting.points;
  clock.end_step("filter", voting.points.size(), "points");

  std::vector<std::vector<Vector3f>> by_kind =
      points_by_kind(std::move(voters), known, settings.vote, settings.fragment);
  for (std::size_t i = 0; i < known.kinds.size(); ++i) {
    voting.of_kinds.push_back(vote_for_axes(std::move(by_kind[i]), known.support, known.camera,
                                            known.kinds[i].radius, settings.vote));
  }
  clock.end_step("vote", number_of_votes(voting), "votes");

  RangeImage seen({}, known.camera, surely_solid_parts(known.support));
  for_each_seen(cropped, voting.filtered, ratio, seed, [&](std::size_t i) { seen.add(cloud.points[i]); });
  const OtherSurfaces others = other_surfaces(voting, known.support, cloud.points.size());
  std::vector<AxisModel> tries;
  const auto model_with = [&](double shift) {
    return model_votes(voting, seen, {cloud, cropped, known, others, blended}, settings, shift, tries,
                       at_step);
  };
  tries.push_back(model_with(0));
  for (const double shift : other_shifts) {
    if (!is_in_doubt(likeliest_of(tries).model, settings.fragment)) break;
    tries.push_back(model_with(shift));
  }
  AxisModel& best = likeliest_of(tries);
  weigh_by_others(best, tries, with_lengths(known, best.model.estimated_lengths));
  for (const AxisModel& tried : tries) {
    if (&tried != &best) add_times(best.model.steps, tried.model.steps);
  }
  best.model.steps.insert(best.model.steps.begin(), steps.begin(), steps.end());
  return std::move(best);
}

}  // namespace tanglebin
