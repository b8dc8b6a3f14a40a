#pragma once

#include <Eigen/Core>
#include <vector>

#include "tanglebin/base/random.hpp"
#include "tanglebin/generate/tube_spec.hpp"
#include "tanglebin/geometry/tube.hpp"

namespace tanglebin {

/// Algorithm 2: `cylinders` lengths of at least `shortest` that add up to `total`, drawn one after the other
/// from what remains (real numbers, as in the published data; the paper prints RandomInteger). Metres.
std::vector<double> draw_lengths(Rng& rng, int cylinders, double total, double shortest);

/// Algorithm 3: the endpoints of consecutive cylinders, the first at the origin. The first direction has
/// azimuth uniform in [0, 2π) and polar angle uniform in [0, π], as the paper prints it; each next one bends
/// from the previous by an angle uniform in [bend_min, bend_max] (rad) towards a uniform azimuth. Line 11 is
/// corrected: the rotation is the one that turns +z onto the previous direction.
std::vector<Eigen::Vector3d> draw_endpoints(Rng& rng, const std::vector<double>& lengths, double bend_min,
                                            double bend_max);

/// The bar that a spec with pieces describes, with node 1 at the origin and its centre line as centre_line()
/// has it; its mass is the spec's, 0 with a density.
Tube straight_up_bar(const TubeSpec& spec, int id);

/// Algorithm 1 for one tube: a tube with node 1 at the origin. Drawn again while it passes through itself;
/// throws InputError after 1000 such draws. A bar is only turned. `spec` must be valid.
Tube draw_tube(Rng& rng, const TubeSpec& spec, int id);

/// Does the tube's surface meet itself anywhere but at the bends of its own centre line? True where the
/// distance between two points of the centre line has a local minimum below the diameter.
bool passes_through_itself(const Tube& tube);

}  // namespace tanglebin
