#pragma once

#include <cstddef>
#include <vector>

#include "tanglebin/dataset/seen_case.hpp"
#include "tanglebin/model/axis/links/links.hpp"

namespace tanglebin {

/// A possible link between two fragments of a scene, and whether a tube really has it.
struct LinkExample {
  LinkKind kind;
  LinkFeatures features;
  bool is_true;
};

/// An end of a fragment, with its possible links; at most one can be chosen.
using EndExample = std::vector<LinkExample>;

/// The ends in a scanner's cloud of a case in the dataset, each with all links that the axis method
/// considers, however unlikely. A link is true if most points of both fragments are on one tube, the
/// fragments face each other along it, and no other fragment of the tube is in between. Throws InputError as
/// read_seen_case() does.
std::vector<EndExample> end_examples(const Dataset& dataset, const SeenCase& seen);

/// The weights with which the ends are likeliest to choose a true link, or none if none is true: conditional
/// logit (McFadden 1974, "Conditional logit analysis of qualitative choice behavior"), solved by Newton's
/// method with a ridge of 0.001. A longer gap never makes a link likelier: where its weight would be above 0,
/// it is 0, and the others are learned without it. Zero for a kind of link without examples.
LinkWeights learn_weights(const std::vector<EndExample>& ends);

}  // namespace tanglebin
