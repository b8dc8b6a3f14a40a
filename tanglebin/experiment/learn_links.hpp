#pragma once

#include <cstddef>
#include <vector>

#include "tanglebin/dataset/dataset.hpp"
#include "tanglebin/model/axis/links.hpp"

namespace tanglebin {

/// A link that there may be between two fragments of a scene, and whether a tube has it.
struct LinkExample {
  LinkKind kind;
  LinkFeatures features;
  bool is_true;
};

/// An end of a fragment: the links that it may have, of which at most one can be chosen.
using EndExample = std::vector<LinkExample>;

/// The ends in the cloud of a case that is there, each with all links that the axis method considers, however
/// unlikely. One is true where most points of both fragments are one tube's, what it joins faces each other
/// along that tube, and no other fragment of the tube is in between. Throws InputError as read_case() does.
std::vector<EndExample> end_examples(const Dataset& dataset, const CaseId& id);

/// Weights with which the ends are the likeliest to choose a true link, or none where none is true:
/// conditional logit (McFadden 1974, "Conditional logit analysis of qualitative choice behavior"), by
/// Newton's method with a ridge of 0.001; zero for a kind of which there are none.
LinkWeights learn_weights(const std::vector<EndExample>& ends);

}  // namespace tanglebin
