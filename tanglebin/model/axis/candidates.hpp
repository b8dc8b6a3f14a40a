#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "tanglebin/geometry/tube.hpp"
#include "tanglebin/model/axis/axis_method.hpp"
#include "tanglebin/model/axis/fragments/tube_surface.hpp"
#include "tanglebin/model/axis/seen_radius.hpp"
#include "tanglebin/model/axis/settings/axis_settings.hpp"
#include "tanglebin/model/scene/known_scene.hpp"

namespace tanglebin {

/// A tube that fits joined fragments, if there is one.
struct TubeCandidate {
  std::vector<std::size_t> fragments;  ///< indices into AxisSteps::fragments, ascending
  std::size_t points;                  ///< of the fragments
  Tube tube;
  std::optional<TubeSurface> surface;  ///< none where the support holds_only_tubes() and nobody asks
  std::vector<SeenRadius>
      seen{};  ///< of all its points, then of those of each fragment, as far as they show one
};

/// What was taken for a tube of a known kind.
struct ForeignTube {
  TubeCandidate candidate;
  double radius;  ///< m, as seen
};

/// Fits a tube to each set of fragments in `steps.tubes`, but for specks: of these next to nothing is seen;
/// or no more than of a ball, and the rest should have been seen. A ball is no tube either if its ends
/// should be flat, or nothing is known of its length.
std::vector<TubeCandidate> fit_candidates(const AxisSteps& steps, const std::vector<Eigen::Vector3f>& points,
                                          const KnownScene& known, const AxisSettings& settings);

using CandidatesByKind = std::vector<std::vector<TubeCandidate>>;

/// In a bin without a margin there are tubes. Elsewhere there may also be the rim of a bin, a box, or a pipe
/// of quite another radius; and without a support walls, so that what shows too little to tell is no tube
/// there. Takes out what is no tube of its kind, and returns it; but what lies along the rim of the known
/// bin, however round that is, it drops.
CandidatesByKind take_what_is_no_tube(CandidatesByKind& of_kinds, const Support& support);

/// Takes the tubes out that clearly show a radius, all along or in one of their fragments, that none of the
/// kinds has: clearly compared with what the other tubes show. If most of these do not show what is known,
/// that is wrong or the scan is, and none is taken out. Returns them by kind, with those among the `odd`,
/// which are no tubes of their kind, that show such a radius to within 5 %.
std::vector<std::vector<ForeignTube>> take_foreign(CandidatesByKind& of_kinds, CandidatesByKind odd,
                                                   const std::vector<TubeKind>& kinds);

}  // namespace tanglebin
